#include "acquisition/runfile/certificate_numbers.hpp"

#include "acquisition/runfile/durable_file.hpp"

#include <algorithm>
#include <charconv>
#include <fcntl.h>
#include <optional>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

namespace axiscal {
namespace {

struct GivenNumber {
    long count = 0; ///< 0: a plain number, which counts nothing
    int closing = 0;
    std::string run_id, number;
};

struct GivenNumbers {
    std::vector<GivenNumber> all;
    std::size_t bytes = 0; ///< of whole lines; what stands behind them was never given
    [[nodiscard]] const GivenNumber* of(const NumberWanted& wanted) const {
        const auto found = std::ranges::find_if(all, [&](const GivenNumber& given) {
            return given.run_id == wanted.run_id && given.closing == wanted.closing;
        });
        return found == all.end() ? nullptr : &*found;
    }
    [[nodiscard]] const GivenNumber* named(const std::string& number) const {
        const auto found = std::ranges::find(all, number, &GivenNumber::number);
        return found == all.end() ? nullptr : &*found;
    }
    [[nodiscard]] long highest() const {
        long count = 0;
        for (const GivenNumber& given : all)
            count = std::max(count, given.count);
        return count;
    }
};

template <class Number> std::optional<Number> number_in(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < 0) return std::nullopt;
    return number;
}

std::optional<GivenNumber> line_in(std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t begin = 0; begin <= line.size();) {
        const auto end = std::min(line.find('\t', begin), line.size());
        fields.push_back(line.substr(begin, end - begin));
        begin = end + 1;
    }
    if (fields.size() != 4 || fields[2].empty() || fields[3].empty()) return std::nullopt;
    const auto count = number_in<long>(fields[0]);
    const auto closing = number_in<int>(fields[1]);
    if (!count || !closing) return std::nullopt;
    return GivenNumber{*count, *closing, std::string{fields[2]}, std::string{fields[3]}};
}

Result<std::string> whole_text(const FileHandle& file, const std::string& path) {
    std::string text;
    std::vector<char> block(block_for(file));
    for (;;) {
        const auto got = ::read(file.get(), block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail_io("cannot read", path);
        if (got == 0) return text;
        text.append(block.data(), static_cast<std::size_t>(got));
    }
}

/// A last line without its end was being written when the power went: nobody was given it.
Result<GivenNumbers> read_numbers(const FileHandle& file, const std::string& path) {
    AXISCAL_TRY(const std::string text, whole_text(file, path));
    GivenNumbers numbers;
    for (int line = 1;; ++line) {
        const auto end = text.find('\n', numbers.bytes);
        if (end == std::string::npos) return numbers;
        auto given = line_in(std::string_view{text}.substr(numbers.bytes, end - numbers.bytes));
        if (!given)
            return fail(Fault::refused,
                        path + ", line " + std::to_string(line) +
                            " is damaged: put the file back from a backup. It says which numbers "
                            "certificates bear, so that none is given twice");
        numbers.all.push_back(*std::move(given));
        numbers.bytes = end + 1;
    }
}

Result<void> append_number(const FileHandle& file,
                           const std::string& path,
                           const GivenNumber& given,
                           std::size_t behind) {
    const std::string line = std::to_string(given.count) + '\t' + std::to_string(given.closing) +
                             '\t' + given.run_id + '\t' + given.number + '\n';
    if (::ftruncate(file.get(), static_cast<off_t>(behind)) != 0)
        return fail_io("cannot cut", path);
    const auto written = ::pwrite(file.get(), line.data(), line.size(), static_cast<off_t>(behind));
    if (written < 0) return fail_io("cannot write", path);
    if (static_cast<std::size_t>(written) != line.size())
        return fail_io("cannot write", path, ENOSPC);
    if (::fsync(file.get()) != 0) return fail_io("cannot sync", path);
    return sync_folder(folder_of(path));
}

std::string padded(long count, std::size_t digits) {
    std::string text = std::to_string(count);
    return std::string(digits > text.size() ? digits - text.size() : 0, '0') + text;
}

/// The tokens were checked with the station file; what is none stays as it stands.
std::string filled_in(std::string pattern, int year, long count) {
    const auto put = [&](const std::string& token, const std::string& value) {
        for (auto at = pattern.find(token); at != std::string::npos;
             at = pattern.find(token, at + value.size()))
            pattern.replace(at, token.size(), value);
    };
    constexpr std::size_t digits_of_year = 4, most_digits = 9;
    put("{year}", padded(year, digits_of_year));
    put("{count}", std::to_string(count));
    for (std::size_t digits = 1; digits <= most_digits; ++digits)
        put("{count:" + std::to_string(digits) + "}", padded(count, digits));
    return pattern;
}

GivenNumber next_number(const GivenNumbers& numbers, const NumberWanted& wanted) {
    GivenNumber fresh{0, wanted.closing, wanted.run_id, wanted.pattern};
    if (is_number_pattern(wanted.pattern)) {
        fresh.count = numbers.highest();
        do
            fresh.number = filled_in(wanted.pattern, wanted.year, ++fresh.count);
        while (numbers.named(fresh.number) != nullptr);
        return fresh;
    }
    for (int copy = 2; numbers.named(fresh.number) != nullptr; ++copy)
        fresh.number = wanted.pattern + "-" + std::to_string(copy);
    return fresh;
}

} // namespace

bool is_number_pattern(std::string_view text) {
    return text.find_first_of("{}") != std::string_view::npos;
}

Result<std::string> take_certificate_number(const std::string& state_directory,
                                            const NumberWanted& wanted) {
    const std::string path = state_directory + "/" + std::string{certificate_numbers_file};
    const FileHandle file{::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0640)};
    if (!file) return fail_io("cannot open", path);
    while (::flock(file.get(), LOCK_EX) != 0) // goes with the descriptor, however we end
        if (errno != EINTR) return fail_io("cannot lock", path);
    AXISCAL_TRY(const GivenNumbers numbers, read_numbers(file, path));
    if (const GivenNumber* given = numbers.of(wanted)) return given->number;
    GivenNumber fresh = next_number(numbers, wanted);
    AXISCAL_CHECK(append_number(file, path, fresh, numbers.bytes));
    return std::move(fresh.number);
}

Result<void> check_number_is_free(const std::string& state_directory, const std::string& number) {
    if (number.empty() || is_number_pattern(number)) return {};
    const std::string path = state_directory + "/" + std::string{certificate_numbers_file};
    const FileHandle file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW)};
    if (!file && errno == ENOENT) return {};
    if (!file) return fail_io("cannot open", path);
    AXISCAL_TRY(const GivenNumbers numbers, read_numbers(file, path));
    const GivenNumber* given = numbers.named(number);
    if (given == nullptr) return {};
    return fail(Fault::refused,
                "certificate number " + number + " was given to run " + given->run_id +
                    ": state another one (--state-that certificate_number=...), or write a pattern "
                    "into the station file, [certificate] number = \"CAL-{year}-{count:4}\"");
}

} // namespace axiscal
