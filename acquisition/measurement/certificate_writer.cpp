#include "acquisition/measurement/certificate_writer.hpp"

#include "acquisition/capture/wording.hpp"
#include "drivers/loop/child_process.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal {
namespace {

namespace asio = boost::asio;

constexpr std::size_t longest_answer = std::size_t{64} * 1024;

using Stream = asio::posix::stream_descriptor;

/// Ends a hung program, and the waiting for what it says: a child of its own may hold the pipe.
struct KillLate {
    std::shared_ptr<Stream> process, output;
    std::shared_ptr<bool> killed;
    void operator()(boost::system::error_code cancelled) const {
        if (cancelled || !process->is_open()) return;
        *killed = true;
        ::syscall(SYS_pidfd_send_signal, process->native_handle(), SIGKILL, nullptr, 0U);
        output->close();
    }
};

/// "R: fail" of the row that comes before the paths.
std::string verdict_in(const std::string& said) {
    const auto row = nlohmann::json::parse(said.substr(0, said.find('\n')), nullptr, false);
    if (!row.is_object()) return {};
    const auto parameter = row.find("parameter"), verdict = row.find("verdict");
    if (parameter == row.end() || verdict == row.end()) return {};
    if (!parameter->is_string() || !verdict->is_string()) return {};
    return parameter->get<std::string>() + ": " + verdict->get<std::string>();
}

/// The sentences of "setup"; what is none is left out.
std::vector<std::string> setup_findings_in(const nlohmann::json& answer) {
    std::vector<std::string> sentences;
    const auto found = answer.find("setup");
    if (found == answer.end() || !found->is_array()) return sentences;
    for (const auto& sentence : *found)
        if (sentence.is_string()) sentences.push_back(sentence.get<std::string>());
    return sentences;
}

std::string word_of(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// The rows of "to_answer"; one without its name cannot be answered.
std::vector<OpenFinding> unanswered_in(const nlohmann::json& answer) {
    std::vector<OpenFinding> findings;
    const auto rows = answer.find("to_answer");
    if (rows == answer.end() || !rows->is_array()) return findings;
    for (const auto& row : *rows) {
        if (!row.is_object() || word_of(row, "error").empty()) continue;
        findings.push_back({word_of(row, "error"), word_of(row, "seen"), word_of(row, "probably"),
                            word_of(row, "look_at")});
    }
    return findings;
}

} // namespace

Task<Result<WrittenCertificate>> write_certificate(Scheduler& scheduler,
                                                   std::string program,
                                                   std::string run_file,
                                                   std::string outbox,
                                                   std::chrono::milliseconds limit) {
    const std::vector<std::string> words{program, run_file, "--outbox", outbox};
    AXISCAL_CO_TRY(const ChildProcess child, start_child(words));
    const auto output = std::make_shared<Stream>(scheduler.executor(), child.output);
    const auto process = std::make_shared<Stream>(scheduler.executor(), child.process);
    const auto killed = std::make_shared<bool>(false);
    asio::steady_timer deadline{scheduler.executor(), limit}; // another process: real time
    deadline.async_wait(KillLate{process, output, killed});
    std::string said;
    co_await asio::async_read(*output, asio::dynamic_buffer(said, longest_answer),
                              asio::as_tuple(asio::use_awaitable));
    output->close(); // one that goes on talking is ended by it
    co_await process->async_wait(Stream::wait_read, asio::as_tuple(asio::use_awaitable));
    deadline.cancel();
    process->close();
    int status = 0;
    ::waitpid(child.pid, &status, 0); // it has ended: this does not wait
    if (*killed)
        co_return fail(Fault::io,
                       program + " has not finished after " + in_seconds(limit) + " and was ended");
    const std::string line = last_line_of(said);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        co_return fail(Fault::io, program + " failed: " + line);
    const auto answer = nlohmann::json::parse(line, nullptr, false);
    if (!answer.is_object() || !answer.contains("entry") || !answer["entry"].is_string())
        co_return fail(Fault::io, program + " said nothing of its entry: " + line);
    WrittenCertificate written{answer["entry"].get<std::string>(), verdict_in(said),
                               setup_findings_in(answer), unanswered_in(answer)};
    co_return written;
}

std::string sibling_program(const std::string& name) {
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto beside = self.parent_path() / name;
    return !error && std::filesystem::exists(beside, error) ? beside.string() : name;
}

} // namespace axiscal
