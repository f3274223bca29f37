#include "tools/axiscal/cases/circular_report_member.hpp"

#include "tools/axiscal/cases/case_reader.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;

struct TextPlace {
    const char* key;
    std::string* place;
};

/// Texts of `given` into their places. What does not stand there stays.
Result<void>
read_texts(const json& given, const std::string& field, const std::vector<TextPlace>& places) {
    for (const auto& [key, place] : places) {
        if (!given.contains(key)) continue;
        AXISCAL_TRY(*place, text_of(given, key, field + "." + key));
    }
    return {};
}

/// A remark that is a text; others are free to be anything.
std::string remark(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::vector<TextPlace> text_places(CircularReportWords& words) {
    Statements& said = words.statements;
    CircularConditions& conditions = words.conditions;
    return {{"id", &words.id},
            {"date", &words.date},
            {"certificate_number", &said.certificate_number},
            {"laboratory", &said.laboratory},
            {"customer", &said.customer},
            {"place", &said.place},
            {"machine", &said.machine},
            {"machine_maker", &said.machine_maker},
            {"machine_serial", &said.machine_serial},
            {"operator", &said.operator_name},
            {"approver", &said.approver},
            {"procedure", &said.procedure},
            {"state", &said.state},
            {"next_due", &said.next_due},
            {"control_compensation", &said.control_compensation},
            {"warm_up", &said.warm_up},
            {"idle_axes", &said.idle_axes},
            {"tool_offset", &conditions.tool_offset},
            {"work_offset", &conditions.work_offset},
            {"filter", &conditions.filter},
            {"angle_origin", &conditions.angle_origin},
            {"feed_in", &conditions.feed_in}};
}

Result<void> read_numbers(const json& given, CircularConditions& conditions) {
    const std::string field = "report.";
    constexpr double coldest = -100, warmest = 200, most = 1e12, widest = 360;
    struct NumberPlace {
        const char* key;
        std::optional<double>* place;
        double least, most;
    };
    for (const auto& [key, place, least, limit] :
         {NumberPlace{"air_degC", &conditions.air.mean_degC, coldest, warmest},
          NumberPlace{"sample_rate_hz", &conditions.sample_rate_hz, 0, most},
          NumberPlace{"overshoot_deg", &conditions.overshoot_deg, 0, widest}}) {
        if (!given.contains(key)) continue;
        AXISCAL_TRY(const double value, number_at(given, key, field + key));
        if (!(value >= least && value <= limit))
            return refuse(Fault::bad_case, field + key, "is of no size that makes sense");
        *place = value;
    }
    if (!given.contains("centre_mm")) return {};
    AXISCAL_TRY(const std::vector<double> centre,
                numbers_at(given, "centre_mm", "report.centre_mm"));
    if (centre.size() != 3)
        return refuse(Fault::bad_case, "report.centre_mm", "must hold three numbers: X, Y, Z");
    conditions.centre_mm = std::array<double, 3>{centre[0], centre[1], centre[2]};
    return {};
}

Result<InstrumentRecord> instrument_of(const json& given, const std::string& field) {
    AXISCAL_CHECK(check_object(
        given, field,
        {"name", "maker", "model", "serial", "certificate_number", "calibrated_on", "due_on"}));
    InstrumentRecord instrument;
    AXISCAL_CHECK(read_texts(given, field,
                             {{"name", &instrument.name},
                              {"maker", &instrument.maker},
                              {"model", &instrument.model},
                              {"serial", &instrument.serial},
                              {"certificate_number", &instrument.certificate_number},
                              {"calibrated_on", &instrument.calibrated_on},
                              {"due_on", &instrument.due_on}}));
    if (instrument.name.empty()) instrument.name = "instrument";
    return instrument;
}

Result<void> read_instruments(const json& given, std::vector<InstrumentRecord>& instruments) {
    if (!given.contains("instruments")) return {};
    const json& list = given.at("instruments");
    if (!list.is_array())
        return refuse(Fault::bad_case, "report.instruments", "must be an array of objects");
    for (std::size_t i = 0; i < list.size(); ++i) {
        AXISCAL_TRY(InstrumentRecord instrument,
                    instrument_of(list[i], indexed("report.instruments", i)));
        instruments.push_back(std::move(instrument));
    }
    return {};
}

void take_remarks(const json& object, CircularReportWords& words) {
    Statements& said = words.statements;
    for (const auto& [key, place] :
         {TextPlace{"id", &words.id}, TextPlace{"date", &words.date},
          TextPlace{"customer", &said.customer}, TextPlace{"place", &said.place},
          TextPlace{"machine", &said.machine}, TextPlace{"operator", &said.operator_name}})
        *place = remark(object, key);
    if (const std::string model = remark(object, "instrument"); !model.empty()) {
        words.instruments.emplace_back();
        words.instruments.back().name = "instrument";
        words.instruments.back().model = model;
    }
}

} // namespace

Result<CircularReportWords> report_of(const json& object) {
    CircularReportWords words;
    take_remarks(object, words);
    if (!object.contains("report")) return words;
    const json& given = object.at("report");
    const std::vector<TextPlace> places = text_places(words);
    Words known{"air_degC", "sample_rate_hz", "overshoot_deg", "centre_mm", "instruments"};
    for (const TextPlace& text : places)
        known.emplace_back(text.key);
    AXISCAL_CHECK(check_object(given, "report", known));
    AXISCAL_CHECK(read_texts(given, "report", places));
    AXISCAL_CHECK(read_numbers(given, words.conditions));
    if (given.contains("instruments")) words.instruments.clear();
    AXISCAL_CHECK(read_instruments(given, words.instruments));
    return words;
}

CircularMeasurement measurement_of(CircularInput input) {
    CircularMeasurement measured;
    measured.taken_elsewhere = true;
    measured.axes = input.axes;
    measured.f_centre = input.f_centre;
    measured.expansion = input.bar;
    measured.conditions = std::move(input.report.conditions);
    if (input.bar) {
        measured.conditions.bar.mean_degC = input.bar->bar_degC;
        measured.conditions.machine.mean_degC = input.bar->machine_degC;
    }
    if (input.uncertainty) {
        measured.stated = input.uncertainty->stated;
        measured.trials = input.uncertainty->trials;
        measured.conditions.repeats = measured.stated->runs;
    }
    measured.run.tolerances = std::move(input.tolerances);
    measured.run.run_id = input.report.id;
    measured.run.statements = std::move(input.report.statements);
    measured.run.instruments = std::move(input.report.instruments);
    measured.started_utc = measured.finished_utc = input.report.date;
    measured.next_due = measured.run.statements.next_due;
    measured.test = std::move(input.test);
    return measured;
}

} // namespace axiscal
