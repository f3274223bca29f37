#include "analysis/positioning/reference_angles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace axiscal {
namespace {

/// Twice what an autocollimator sees; less than half of any common face pitch.
constexpr double beside_face_deg = 1;

std::string indexed(const std::string& field, std::size_t index) {
    return field + "[" + std::to_string(index) + "]";
}

Result<void> check_faces(const ReferenceAngles& reference, std::size_t targets) {
    const std::size_t faces = reference.deviation_arcsec.size();
    if (faces < 2)
        return refuse(Fault::bad_case, reference.deviation_field, "must name two faces or more");
    if (reference.face_of_target.size() != targets)
        return refuse(Fault::bad_case, reference.face_field,
                      "has " + std::to_string(reference.face_of_target.size()) + " numbers for " +
                          std::to_string(targets) + " targets");
    for (std::size_t i = 0; i < targets; ++i)
        if (const int face = reference.face_of_target[i];
            face < 1 || face > static_cast<int>(faces))
            return refuse(Fault::bad_case, indexed(reference.face_field, i),
                          "is no face: they are numbered from 1 to " + std::to_string(faces));
    return {};
}

/// First target that lies beside its face when the faces are numbered `way` (+1 or -1) round; the
/// number of targets when none does.
std::size_t first_beside(const ReferenceAngles& reference,
                         const std::vector<double>& targets,
                         double degrees_per_target_unit,
                         int way) {
    const double pitch = 360.0 / static_cast<double>(reference.deviation_arcsec.size());
    for (std::size_t i = 1; i < targets.size(); ++i) {
        const double turn = (targets[i] - targets[0]) * degrees_per_target_unit;
        const int faces = reference.face_of_target[i] - reference.face_of_target[0];
        if (std::fabs(std::remainder(turn - way * faces * pitch, 360.0)) > beside_face_deg)
            return i;
    }
    return targets.size();
}

Result<void> check_places(const ReferenceAngles& reference,
                          const std::vector<double>& targets,
                          double degrees_per_target_unit) {
    const auto worst = std::max(first_beside(reference, targets, degrees_per_target_unit, 1),
                                first_beside(reference, targets, degrees_per_target_unit, -1));
    if (worst == targets.size()) return {};
    return refuse(Fault::bad_case, indexed(reference.face_field, worst),
                  "is not the face that stands before the instrument at this target, whichever "
                  "way round the " +
                      std::to_string(reference.deviation_arcsec.size()) + " faces are numbered");
}

} // namespace

Result<void> take_out_reference(const ReferenceAngles& reference,
                                double degrees_per_unit,
                                double degrees_per_target_unit,
                                DeviationTable& table) {
    AXISCAL_CHECK(check_faces(reference, table.targets.size()));
    AXISCAL_CHECK(check_places(reference, table.targets, degrees_per_target_unit));
    const double units_per_arcsec = 1 / (3600 * degrees_per_unit);
    const double reading_sign = reference.reading_with_axis ? 1 : -1;
    const double face_sign = reference.certificate_with_axis ? 1 : -1;
    for (auto* rows : {&table.forward, &table.backward})
        for (std::size_t i = 0; i < rows->size(); ++i) {
            const auto face = static_cast<std::size_t>(reference.face_of_target[i] - 1);
            const double deviation =
                face_sign * reference.deviation_arcsec[face] * units_per_arcsec;
            for (double& value : (*rows)[i])
                value = reading_sign * value - deviation;
        }
    return {};
}

} // namespace axiscal
