#pragma once
// Between a program and axiscald-tls.so, which alone links OpenSSL and is loaded by the stations
// that name a certificate. What passes are descriptors and texts: each side has an event loop of
// its own, and no object of Asio crosses.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace axiscal {

struct TlsFiles {
    std::string certificate; ///< PEM: the station's own first, then those between it and the root
    std::string key;         ///< PEM, without a pass phrase
};

/// What is to be said about a pair of files.
struct TlsFinding {
    bool of_key = false;  ///< else of the certificate
    bool refuses = false; ///< else it is worth a note, and the pair serves
    std::string sentence;
};

enum class TlsNews : std::uint8_t {
    turned_away, ///< a client; `words` says why
    renewed,     ///< other files serve from now on
    kept,        ///< the files have changed and are no good: the earlier ones go on
};
struct TlsTold {
    TlsNews news = TlsNews::turned_away;
    std::string address; ///< of the client
    std::string words;
};

struct TlsLimits {
    std::chrono::milliseconds handshake{10'000}; ///< from the connection to its end
    std::chrono::milliseconds taking{30'000};    ///< for a client to take 8 KiB
    std::chrono::milliseconds farewell{2'000};   ///< for what a client still sends at the end
    std::chrono::milliseconds look{60'000};      ///< between two looks at the files
};

/// Speaks TLS with clients, and in clear with the program.
class TlsDoor {
public:
    virtual ~TlsDoor() = default;
    /// Works until stop(): for a thread of its own. Handshakes are arithmetic of milliseconds, and
    /// files may hang; neither may hold the loop of the station.
    virtual void run() = 0;
    /// From any thread; hangs up on everybody.
    virtual void stop() = 0;
    /// From any thread. Owns both from now on: `client` is a TCP connection, `plain` one end of a
    /// socket pair, at whose other end the program reads and writes what is carried.
    virtual void carry(int client, int plain, std::string address) = 0;
};

class TlsModule {
public:
    /// @param utc_s  when "now" is, for validity
    virtual std::vector<TlsFinding> judge(const TlsFiles& files, std::int64_t utc_s) = 0;
    /// Null where the files are refused. @param tell  is called on the thread of run()
    virtual std::unique_ptr<TlsDoor>
    open(const TlsFiles& files, const TlsLimits& limits, std::function<void(TlsTold)> tell) = 0;

protected:
    ~TlsModule() = default; // lives as long as the process
};

/// What both sides must have been built with.
inline constexpr const char* tls_interface = AXISCAL_VERSION " interface 1";
inline constexpr const char* tls_entry = "axiscal_tls_module";
/// Null for another interface than the module's own.
using TlsEntry = TlsModule* (*)(const char* interface);

} // namespace axiscal
