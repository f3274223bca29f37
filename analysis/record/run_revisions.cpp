#include "analysis/record/run_revisions.hpp"

namespace axiscal {

std::string name_of(const Orderer& by) {
    std::string door = by.door == "socket" ? std::string{} : by.door;
    if (by.uid) {
        if (!by.user.empty()) door = "user " + by.user + ", ";
        door += "uid " + std::to_string(*by.uid);
    } else if (!by.user.empty() && by.user != by.door) {
        door += " " + by.user;
    }
    if (by.name.empty()) return door.empty() ? "not known" : door;
    return door.empty() ? by.name : by.name + " (" + door + ")";
}

} // namespace axiscal
