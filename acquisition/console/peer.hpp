#pragma once
// Who is at the other end of a connection, as the kernel knows it.

#include "analysis/record/run_revisions.hpp"

#include <string>

namespace axiscal {

/// The user of that id in a file as /etc/passwd; empty where it names none. Users that only a
/// directory service knows have no name here: asking it could hold the loop up.
std::string user_name_of(std::int64_t uid, const std::string& passwd = "/etc/passwd");

/// Door "socket", with the credentials that the kernel noted when the process connected.
Orderer peer_of_socket(int descriptor);

/// Whether the other end is closed, so that nobody reads the answer. Never waits.
bool has_hung_up(int descriptor);

} // namespace axiscal
