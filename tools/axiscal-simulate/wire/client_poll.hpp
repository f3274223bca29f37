#pragma once
// How often a face that serves clients by TCP looks up from waiting for them.

namespace axiscal::simulate {

/// So long a face waits for its clients before it looks whether it shall stop, ms.
inline constexpr int client_poll_ms = 20;

} // namespace axiscal::simulate
