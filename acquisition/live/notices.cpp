#include "acquisition/live/notices.hpp"

#include "analysis/quantity/valid_text.hpp"

#include <spdlog/spdlog.h>

#include <utility>

namespace axiscal {
namespace {

constexpr std::size_t kept_notes = 20;

void log_about(const LogFacts& facts, const std::string& message) {
    const LogAbout about{facts};
    spdlog::info("{}", message);
}

} // namespace

void Notices::note(const std::string& sentence, LogFacts facts) {
    std::string message = valid_text(sentence); // of errors, which may quote a client or a file
    if (facts.run.empty() && open_run_) facts.run = open_run_();
    log_about(facts, message);
    if (listener_) listener_(message, facts);
    const ClockTie tie = scheduler_.clock_tie();
    last_.push_back(iso8601_utc(tie.utc_ns) + " " + std::move(message));
    if (last_.size() > kept_notes) last_.pop_front();
    bell_.ring();
}

void Notices::note_port(Fault fault, std::string sentence) {
    std::string message = describe({fault, std::move(sentence), {}, {}});
    if (message == port_) return;
    note("Trigger port: " + message, {fault});
    port_ = std::move(message);
}

void Notices::note_refusal(std::uint16_t sequence, const Error& error) {
    std::string message = "Request " + std::to_string(sequence) + " is refused: " + describe(error);
    if (message == refused_) return;
    note(message, {error.fault});
    refused_ = std::move(message);
}

} // namespace axiscal
