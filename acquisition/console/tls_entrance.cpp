#include "acquisition/console/tls_entrance.hpp"

#include "acquisition/tls/tls_loading.hpp"
#include "analysis/quantity/valid_text.hpp"

#include <boost/asio/local/connect_pair.hpp>
#include <boost/asio/post.hpp>
#include <spdlog/spdlog.h>

#include <utility>

namespace axiscal {
namespace {

constexpr std::int64_t ns_of_a_second = 1'000'000'000;

/// What a person reads of a pair that is refused; judge_tls() has told where in the station file.
std::string refusals_in(const std::vector<TlsFinding>& findings) {
    std::string words;
    for (const TlsFinding& finding : findings)
        if (finding.refuses) words += (words.empty() ? "" : "; ") + finding.sentence;
    return words;
}

} // namespace

TlsEntrance::TlsEntrance(Scheduler& scheduler)
    : scheduler_{scheduler} {}

Result<std::shared_ptr<TlsEntrance>> TlsEntrance::open(Scheduler& scheduler,
                                                       const ConsoleConfig& config) {
    AXISCAL_TRY(TlsModule* const module, load_tls_module());
    const TlsFiles files{config.certificate, config.key};
    auto entrance = std::make_shared<TlsEntrance>(scheduler);
    // On the door's thread; what is told late, to an entrance that has gone, is dropped.
    auto hear = [loop = scheduler.executor(), weak = entrance->weak_from_this()](TlsTold told) {
        boost::asio::post(loop, [weak, told = std::move(told)] {
            if (const auto self = weak.lock()) self->tell(told);
        });
    };
    entrance->door_ = module->open(files, TlsLimits{}, std::move(hear));
    if (!entrance->door_)
        return fail(
            Fault::bad_configuration,
            "[console] certificate and key: " +
                refusals_in(module->judge(files, scheduler.clock_tie().utc_ns / ns_of_a_second)));
    entrance->thread_ = std::make_unique<WorkThread>();
    entrance->thread_->post([door = entrance->door_.get()] { door->run(); });
    return entrance;
}

TlsEntrance::~TlsEntrance() {
    if (!thread_) return;
    door_->stop();
    thread_->finish();
    thread_->join();
}

Result<TlsEntrance::Plain> TlsEntrance::take(boost::asio::ip::tcp::socket client) {
    boost::system::error_code error;
    const auto remote = client.remote_endpoint(error);
    std::string address = error ? "" : remote.address().to_string();
    Plain ours{scheduler_.executor()}, theirs{scheduler_.executor()};
    boost::asio::local::connect_pair(ours, theirs, error);
    if (error) return fail(Fault::io, "no socket pair for a client", error);
    const int plain = theirs.release(error);
    if (error) return fail(Fault::io, "a socket pair is not handed over", error);
    const int descriptor = client.release(error);
    if (error) return fail(Fault::io, "a client is not handed over", error);
    door_->carry(descriptor, plain, std::move(address));
    return ours;
}

/// Each address once a day, and of a day the first four: a scanner fills no log.
void TlsEntrance::tell(const TlsTold& told) {
    const std::string words = valid_text(told.words);
    switch (told.news) {
    case TlsNews::turned_away:
        if (const auto whom = strangers_.take(told.address, scheduler_.now()))
            spdlog::warn("The console turned {}: {}.", *whom, words);
        return;
    case TlsNews::renewed:
        spdlog::info("The console takes the changed certificate from now on.{}",
                     words.empty() ? "" : " Its file " + words + ".");
        return;
    case TlsNews::kept:
        spdlog::warn("The changed certificate of the console is not taken, the earlier one goes "
                     "on: {}.",
                     words);
        return;
    }
}

} // namespace axiscal
