// The module's own loop, and what a program calls.
#include "acquisition/tls/module/carried_client.hpp"
#include "acquisition/tls/module/certificate_files.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>

#include <chrono>
#include <cstring>
#include <exception>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace axiscal::tls {
namespace {

namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;

/// The console's 64 requests and 32 listeners, and as many again that are about to leave.
constexpr int most_carried = 192;

std::int64_t now_utc_s() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

int domain_of(int descriptor) {
    int domain = AF_INET;
    socklen_t size = sizeof domain;
    ::getsockopt(descriptor, SOL_SOCKET, SO_DOMAIN, &domain, &size);
    return domain;
}

std::string first_refusal(const std::vector<TlsFinding>& findings) {
    for (const TlsFinding& finding : findings)
        if (finding.refuses) return finding.sentence;
    return {};
}

class Door final : public TlsDoor {
public:
    Door(TlsFiles files,
         const TlsLimits& limits,
         std::function<void(TlsTold)> tell,
         std::string mark,
         std::shared_ptr<asio::ssl::context> certificate)
        : files_{std::move(files)}
        , limits_{limits}
        , tell_{std::move(tell)}
        , mark_{std::move(mark)}
        , certificate_{std::move(certificate)} {}

    void run() override { loop_.run(); }
    void stop() override { loop_.stop(); }
    void carry(int client, int plain, std::string address) override {
        asio::post(loop_,
                   [this, pair = Pair{client, plain}, address = std::move(address)]() mutable {
                       begin(std::move(pair), std::move(address));
                   });
    }

private:
    /// Closed where nobody takes them: at the end of the loop, or of the memory.
    struct Pair {
        Pair(int of_client, int of_program)
            : client{of_client}
            , plain{of_program} {}
        Pair(Pair&& other) noexcept
            : client{std::exchange(other.client, -1)}
            , plain{std::exchange(other.plain, -1)} {}
        Pair& operator=(Pair&&) = delete;
        ~Pair() {
            if (client >= 0) ::close(client);
            if (plain >= 0) ::close(plain);
        }
        int client, plain;
    };

    void begin(Pair pair, std::string address);
    asio::awaitable<void> serve(std::shared_ptr<CarriedClient> client, std::string address);
    void look_at_files();

    TlsFiles files_;
    TlsLimits limits_;
    std::function<void(TlsTold)> tell_;
    std::string mark_; ///< of what was loaded or refused last
    std::shared_ptr<asio::ssl::context> certificate_;
    Clock::time_point looked_ = Clock::now();
    int carried_ = 0;
    asio::io_context loop_{1};
    asio::executor_work_guard<asio::io_context::executor_type> work_{loop_.get_executor()};
};

void Door::begin(Pair pair, std::string address) {
    if (carried_ >= most_carried) return; // both ends are hung up on
    look_at_files();
    boost::system::error_code error;
    const asio::generic::stream_protocol protocol{domain_of(pair.client), 0};
    CarriedClient::Socket client{loop_};
    CarriedClient::Plain plain{loop_};
    client.assign(protocol, pair.client, error);
    if (error) return;
    pair.client = -1;
    plain.assign({}, pair.plain, error);
    if (error) return;
    pair.plain = -1;
    auto carried =
        std::make_shared<CarriedClient>(std::move(client), std::move(plain), certificate_, limits_);
    asio::co_spawn(loop_, serve(std::move(carried), std::move(address)), asio::detached);
}

asio::awaitable<void> Door::serve(std::shared_ptr<CarriedClient> client, std::string address) {
    ++carried_;
    std::string complaint;
    try {
        complaint = co_await client->carry();
    } catch (const std::exception& bug) { // ends this client; the others go on
        complaint = bug.what();
    }
    --carried_;
    if (!complaint.empty()) tell_({TlsNews::turned_away, std::move(address), std::move(complaint)});
}

/// At a connection, for nobody else needs them. A pair that is written file by file is refused in
/// between, and taken at the next look.
void Door::look_at_files() {
    if (Clock::now() - looked_ < limits_.look) return;
    looked_ = Clock::now();
    std::string mark = files_mark(files_);
    if (mark == mark_) return;
    LoadedCertificate loaded = load_certificate(files_, now_utc_s());
    mark_ = std::move(mark);
    if (!loaded.context) {
        tell_({TlsNews::kept, {}, first_refusal(loaded.findings)});
        return;
    }
    certificate_ = std::move(loaded.context);
    tell_({TlsNews::renewed, {}, loaded.findings.empty() ? "" : loaded.findings.front().sentence});
}

class Module final : public TlsModule {
public:
    std::vector<TlsFinding> judge(const TlsFiles& files, std::int64_t utc_s) override {
        return load_certificate(files, utc_s).findings;
    }
    std::unique_ptr<TlsDoor> open(const TlsFiles& files,
                                  const TlsLimits& limits,
                                  std::function<void(TlsTold)> tell) override {
        std::string mark = files_mark(files); // before: what is written meanwhile is seen later
        LoadedCertificate loaded = load_certificate(files, now_utc_s());
        if (!loaded.context) return nullptr;
        return std::make_unique<Door>(files, limits, std::move(tell), std::move(mark),
                                      std::move(loaded.context));
    }
};

} // namespace
} // namespace axiscal::tls

extern "C" __attribute__((visibility("default"))) axiscal::TlsModule*
axiscal_tls_module(const char* interface) {
    static axiscal::tls::Module module;
    return std::strcmp(interface, axiscal::tls_interface) == 0 ? &module : nullptr;
}
