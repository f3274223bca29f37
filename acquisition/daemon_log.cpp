#include "acquisition/daemon_log.hpp"

#include "drivers/loop/line_writer.hpp"
#include "drivers/loop/system_journal.hpp"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>
#include <syslog.h>
#include <unistd.h>

namespace axiscal {
namespace {

/// spdlog's own queue wakes each ten seconds for nothing, and waits without end for a pipe
/// that nobody reads when it is taken down.
class StderrSink final : public spdlog::sinks::base_sink<std::mutex> {
    void sink_it_(const spdlog::details::log_msg& message) override {
        spdlog::memory_buf_t line;
        formatter_->format(message, line);
        writer_.put(std::string{line.data(), line.size()});
    }
    void flush_() override {} // the writer keeps nothing back

    LineWriter writer_{STDERR_FILENO};
};

int priority_of(spdlog::level::level_enum level) {
    switch (level) {
    case spdlog::level::critical: return LOG_CRIT;
    case spdlog::level::err: return LOG_ERR;
    case spdlog::level::warn: return LOG_WARNING;
    case spdlog::level::info: return LOG_INFO;
    default: return LOG_DEBUG;
    }
}

LineWriter::Deliver to_system_journal() {
    return [journal = std::make_shared<const SystemJournal>(STDERR_FILENO)](const LogLine& line) {
        journal->write(line);
    };
}

/// Time and level are the journal's own fields.
class JournalSink final : public spdlog::sinks::base_sink<std::mutex> {
    void sink_it_(const spdlog::details::log_msg& message) override {
        std::string text{message.payload.data(), message.payload.size()};
        writer_.put(LogLine{std::move(text) + "\n", priority_of(message.level),
                            LogAbout::of_this_thread()});
    }
    void flush_() override {} // the writer keeps nothing back

    LineWriter writer_{to_system_journal()};
};

spdlog::sink_ptr sink_of_stderr() {
    if (leads_to_system_journal(STDERR_FILENO)) return std::make_shared<JournalSink>();
    return std::make_shared<StderrSink>();
}

} // namespace

DaemonLog::DaemonLog() {
    auto log = std::make_shared<spdlog::logger>("axiscald", sink_of_stderr());
    // Under systemd whoever keeps the lines stamps them.
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread changes the environment
    const bool stamped = std::getenv("JOURNAL_STREAM") != nullptr;
    log->set_pattern(stamped ? "%l: %v" : "%H:%M:%S.%e %l: %v");
    spdlog::set_default_logger(std::move(log));
}

DaemonLog::~DaemonLog() {
    spdlog::shutdown();
}

} // namespace axiscal
