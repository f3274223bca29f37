// Plays kept inputs through a target without libFuzzer: replay TARGET_FOLDER. Fails on no input.

#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

int main(int count, char** arguments) {
    if (count != 2) return 2;
    std::vector<std::filesystem::path> kept;
    for (const auto& entry : std::filesystem::directory_iterator{arguments[1]})
        kept.push_back(entry.path());
    std::sort(kept.begin(), kept.end());
    for (const auto& path : kept) {
        std::printf("%s\n", path.filename().c_str());
        std::fflush(stdout); // the last name printed is the input that ended the process
        std::ifstream file{path, std::ios::binary};
        const std::vector<char> bytes{std::istreambuf_iterator<char>{file}, {}};
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    std::printf("%zu inputs replayed\n", kept.size());
    return kept.empty() ? 1 : 0;
}
