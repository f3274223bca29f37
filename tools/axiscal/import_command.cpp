// `axiscal import`: files of other programs as cases.
#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "analysis/quantity/counted.hpp"
#include "analysis/quantity/valid_text.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/analyze_case.hpp"
#include "tools/axiscal/complaint.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/imported_certificate.hpp"
#include "tools/axiscal/imports/import_file.hpp"
#include "tools/axiscal/offline_commands.hpp"
#include "tools/axiscal/whole_file.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>

namespace axiscal {
namespace {

using ImportedJson = nlohmann::json;

/// What the map says, and by what it can be found again: figures follow from file and map.
struct ReadMap {
    std::optional<ImportMap> map;
    std::string words; ///< "by the map rig.toml, SHA-256 ..."; empty: there is none
};

Result<ReadMap> map_in(const std::string& path) {
    if (path.empty()) return ReadMap{};
    AXISCAL_TRY(std::string text, whole_file(path));
    ReadMap read;
    read.words = "by the map " + valid_text(std::filesystem::path{path}.filename().string()) +
                 ", SHA-256 " + sha256_hex(text);
    AXISCAL_TRY(read.map, import_map(std::move(text), path));
    return read;
}

/// A file, and by what it can be found again.
struct ReadImport {
    ImportedFile file;
    ImportedReadings from;
};

Result<ReadImport> read_import(const std::string& path, const ReadMap& by) {
    AXISCAL_TRY(const std::string bytes, whole_file(path));
    auto file = import_file(bytes, by.map);
    if (!file) {
        Error error = file.error();
        error.field = path + (error.field.empty() ? "" : ", " + error.field);
        return tl::unexpected<Error>(std::move(error));
    }
    ReadImport read{*std::move(file), {}};
    read.from.file = valid_text(std::filesystem::path{path}.filename().string());
    read.from.form = read.file.form;
    read.from.sha256 = sha256_hex(bytes);
    read.file.document["source"] =
        read.from.file + ", " + read.from.form + ", SHA-256 " + read.from.sha256;
    if (by.words.empty()) return read;
    read.file.document["source"] =
        read.file.document["source"].get<std::string>() + ", " + by.words;
    read.from.remark = "They were read " + by.words + ".";
    return read;
}

std::string text_about(const ImportedFile& file) {
    const ImportedJson& targets = file.document.value("targets", ImportedJson::array());
    if (targets.empty()) return file.form;
    const auto ways = [&](const char* key) {
        return file.document.contains(key) ? static_cast<long>(file.document[key].at(0).size())
                                           : 0L;
    };
    return file.form + ", " + counted(static_cast<long>(targets.size()), "target") + ", " +
           counted(ways("forward"), "run") + " forward, " + std::to_string(ways("backward")) +
           " backward";
}

/// "A 7.78, E 6.56 um": those that a customer asks for first.
/// @errors Fault::bad_case where the case is none: what axiscal analyze would say.
Result<std::string> first_figures(const ImportedJson& document) {
    const CaseAnswer answer = analyze_cases(json_text(document));
    const ImportedJson result = ImportedJson::parse(answer.output, nullptr, false);
    if (answer.exit_code != exit_ok || !result.is_object())
        return fail(Fault::bad_case, answer.error_line);
    if (!result.contains("parameters") || document.value("analysis", "") != "positioning")
        return std::string{};
    const std::string unit = result.at("unit");
    const bool metric = unit == "mm" || unit == "um" || unit == "m";
    const double factor = unit == "mm" ? 1e3 : unit == "m" ? 1e6 : unit == "deg" ? 3600 : 1;
    std::string text;
    for (const char* key : {"A", "E", "M", "R", "B", "B_mean"}) {
        if (!result["parameters"].contains(key)) continue;
        std::array<char, 48> number{};
        std::snprintf(number.data(), number.size(), "%.2f",
                      result["parameters"][key]["value"].get<double>() * factor);
        text += (text.empty() ? "" : ", ") + std::string{key} + " " + number.data();
    }
    return text + (metric ? " um" : " arcsec");
}

Result<void> tell_import(const std::string& path, const ImportedFile& file) {
    AXISCAL_TRY(const std::string figures, first_figures(file.document));
    std::cout << path << ": " << text_about(file) << "\n";
    for (const std::string& remark : file.remarks)
        std::cout << "  " << remark << "\n";
    if (!figures.empty()) std::cout << "  " << figures << "\n";
    return {};
}

int write_cases(const ImportedJson& cases, const std::string& out) {
    if (std::filesystem::exists(std::filesystem::symlink_status(out)))
        return std::cerr << out << " is there already: name another file\n", exit_refused;
    if (const auto written = replace_synced(out, json_text(cases) + "\n"); !written)
        return complain(written.error());
    std::cout << out << " is written; axiscal analyze " << out << " gives every figure\n";
    return exit_ok;
}

} // namespace

int command_import(const ImportOrder& order, bool json) {
    const auto map = map_in(order.map);
    if (!map) return complain(map.error());
    ImportedJson cases = ImportedJson::array();
    for (const std::string& path : order.files) {
        const auto read = read_import(path, *map);
        if (!read) return complain(read.error());
        cases.push_back(read->file.document);
        if (!order.out.empty()) {
            if (const auto told = tell_import(path, read->file); !told)
                return complain(told.error());
            continue;
        }
        for (const std::string& remark : read->file.remarks)
            std::cerr << path << ": " << remark << "\n";
        if (order.certificate.empty()) continue;
        if (const auto figures = first_figures(read->file.document); !figures)
            return complain(figures.error());
        const int code = certify_import(read->file, read->from, order.certificate, json);
        if (code != exit_ok) return code;
    }
    const ImportedJson all = cases.size() == 1 ? cases.front() : cases;
    if (!order.out.empty()) return write_cases(all, order.out);
    if (order.certificate.empty()) std::cout << json_text(all) << "\n" << std::flush;
    return exit_ok;
}

} // namespace axiscal
