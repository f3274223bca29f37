// A run file that was changed. Input: changes of six bytes (offset 3, cut when 255, length, value)
// to a good file, made once; a whole file when it begins as one. Read, summarized and verified, or
// refused with a reason.

#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_file_verify.hpp"
#include "tests/fuzz/judge.hpp"
#include "tests/unit/runfile/one_row.hpp"
#include "tests/unit/runfile/random_run.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

using namespace axiscal;

namespace {

class Scene {
public:
    Scene()
        : folder_{std::filesystem::temp_directory_path() /
                  ("axiscal-fuzz-" + std::to_string(::getpid()))} {
        std::filesystem::create_directories(folder_);
        const std::string path = folder_ / "good.axiscal";
        testing::RandomRun random{20};
        auto writer = RunFileWriter::create(path, random.header());
        fuzz::require(writer.has_value(), "the good file can be made");
        fuzz::require(testing::append(*writer, random.datum()).has_value(), "a datum is written");
        for (int step = 0; step < 3; ++step)
            fuzz::require(testing::append(*writer, random.point(step)).has_value(), "a point, too");
        fuzz::require(writer->close(true, "done", random.tie()).has_value(), "it can be closed");
        std::ifstream file{path, std::ios::binary};
        good_.assign(std::istreambuf_iterator<char>{file}, {});
        fuzz::require(read_run_file(path).has_value(), "the good file can be read");
    }
    ~Scene() { std::filesystem::remove_all(folder_); }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    [[nodiscard]] std::string good() const { return good_; }
    [[nodiscard]] std::string place(const std::string& content) const {
        std::ofstream file{folder_ / "changed.axiscal", std::ios::binary | std::ios::trunc};
        file << content;
        return folder_ / "changed.axiscal";
    }

private:
    std::filesystem::path folder_;
    std::string good_;
};

std::string changed(std::string content, const std::uint8_t* data, std::size_t size) {
    for (const std::uint8_t* change = data; change + 6 <= data + size; change += 6) {
        const std::size_t begin =
            (65536U * change[0] + 256U * change[1] + change[2]) % content.size();
        const std::size_t length = std::min<std::size_t>(change[4], content.size() - begin);
        std::fill_n(content.begin() + static_cast<std::ptrdiff_t>(begin), length,
                    static_cast<char>(change[5]));
        if (change[3] == 255) content.resize(std::max<std::size_t>(begin, 1));
    }
    return content;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Scene scene;
    const auto text = fuzz::as_text(data, size);
    const std::string path =
        scene.place(text.starts_with("SQLite format 3") ? std::string{text}
                                                        : changed(scene.good(), data, size));
    if (const auto contents = read_run_file_contents(path); !contents)
        fuzz::require(!contents.error().detail.empty(), "a refused file has a reason");
    if (const auto summary = summarize_run_file(path); !summary)
        fuzz::require(!summary.error().detail.empty(), "a refused file has a reason");
    if (const auto chain = verify_chain(path); !chain)
        fuzz::require(!chain.error().detail.empty(), "a refused file has a reason");
    else
        fuzz::require(chain->findings.size() <= ChainReport::most_findings, "findings are bounded");
    return 0;
}
