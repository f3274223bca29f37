#include "tools/axiscal/cases/reference_angles_member.hpp"

#include <cmath>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;

struct ArtefactKeys {
    std::string member, deviations, numbers;
};

ArtefactKeys keys_of(const std::string& member) {
    if (member == "polygon") return {member, "face_deviation_arcsec", "face_of_target"};
    return {member, "index_deviation_arcsec", "index_of_target"};
}

Result<std::vector<int>>
whole_numbers_at(const json& object, const std::string& key, const std::string& field) {
    constexpr double largest = 1e6;
    AXISCAL_TRY(const auto numbers, numbers_at(object, key, field));
    std::vector<int> whole;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (std::fabs(numbers[i]) > largest || numbers[i] != std::floor(numbers[i]))
            return refuse(Fault::bad_case, indexed(field, i), "must be a whole number");
        whole.push_back(static_cast<int>(numbers[i]));
    }
    return whole;
}

/// "with_axis" gives true. `missing` where it may be left out.
Result<bool> sense_of(const json& object,
                      const std::string& key,
                      const std::string& field,
                      std::optional<bool> missing) {
    if (missing && !object.contains(key)) return *missing;
    AXISCAL_TRY(const std::string word, one_of(object, key, field, {"with_axis", "against_axis"}));
    return word == "with_axis";
}

Result<ReferenceAngles> read_artefact(const json& object, const ArtefactKeys& keys) {
    const std::string prefix = keys.member + ".";
    AXISCAL_CHECK(
        check_object(object, keys.member,
                     {keys.deviations, keys.numbers, "certificate_sense", "reading_sense"}));
    ReferenceAngles reference;
    reference.deviation_field = prefix + keys.deviations;
    reference.face_field = prefix + keys.numbers;
    AXISCAL_TRY(reference.deviation_arcsec,
                numbers_at(object, keys.deviations, reference.deviation_field));
    AXISCAL_TRY(reference.face_of_target,
                whole_numbers_at(object, keys.numbers, reference.face_field));
    AXISCAL_TRY(reference.certificate_with_axis,
                sense_of(object, "certificate_sense", prefix + "certificate_sense", {}));
    AXISCAL_TRY(reference.reading_with_axis,
                sense_of(object, "reading_sense", prefix + "reading_sense", true));
    return reference;
}

} // namespace

std::string artefact_key(const json& object) {
    if (object.contains("polygon")) return "polygon";
    return object.contains("indexing_table") ? "indexing_table" : "";
}

Result<void> take_out_artefact(const json& object, const CaseAxis& axis, DeviationTable& table) {
    const std::string key = artefact_key(object);
    if (key.empty()) return {};
    if (key == "polygon" && object.contains("indexing_table"))
        return refuse(Fault::bad_case, "indexing_table", "cannot stand beside a polygon");
    if (axis.kind != AxisKind::rotary)
        return refuse(Fault::bad_case, key, "belongs to a rotary axis");
    if (object.at("readings") != "deviations")
        return refuse(Fault::bad_case, key,
                      "goes with readings that are deviations: the instrument sees small angles");
    AXISCAL_TRY(const ReferenceAngles reference, read_artefact(object.at(key), keys_of(key)));
    return take_out_reference(reference, base_units_in(axis.unit), base_units_in(axis.target_unit),
                              table);
}

} // namespace axiscal
