#include "acquisition/console/http_pairing.hpp"

#include "acquisition/console/paired_file.hpp"
#include "acquisition/console/pairing_json.hpp"
#include "acquisition/console/session_cookie.hpp"
#include "drivers/loop/spawn.hpp"

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <functional>
#include <utility>

namespace axiscal {
namespace {

namespace http = boost::beast::http;

/// As long as browsers keep one at all: the station, not the browser, ends a pairing.
constexpr auto cookie_lasts = std::chrono::hours{400 * 24};

std::vector<PairedBrowser> kept_in(const std::string& file) {
    if (file.empty()) return {};
    auto kept = read_paired(file);
    if (kept) return *std::move(kept);
    const std::error_code& cause = kept.error().cause;
    spdlog::warn("{}{}", kept.error().detail, cause ? " (" + cause.message() + ")" : "");
    return {};
}

std::string cookies_of(const HttpRequest& request) {
    const auto found = request.find(http::field::cookie);
    return found == request.end() ? std::string{} : std::string{found->value()};
}

HttpResponse answer_with_cookie(const HttpRequest& request,
                                const nlohmann::ordered_json& body,
                                const std::string& cookie) {
    HttpResponse response = answer(request, http::status::ok, body);
    response.set(http::field::set_cookie, cookie);
    return response;
}

/// Where a browser would have to go that cannot get in as the station file is.
std::string advice_on(const ConsoleConfig& config) {
    const bool every_address = config.host == "0.0.0.0" || config.host == "::";
    if (every_address && config.allowed_hosts.empty())
        return "Browsers of other PCs are answered only under a name or address of this PC that "
               "stands in console.allowed_hosts.";
    return {};
}

} // namespace

PairingDoor::PairingDoor(Scheduler& scheduler, std::string file)
    : scheduler_{scheduler}
    , file_{std::move(file)}
    , desk_{random_bytes, kept_in(file_)} {}

void PairingDoor::stop() {
    stopped_ = true;
    if (!writer_) return;
    writer_->finish();
    writer_->join();
}

PairingTime PairingDoor::now() const {
    const MonotonicTime at = scheduler_.now();
    return {at, scheduler_.clock_tie().utc_ns_at(at)};
}

std::string PairingDoor::name_of(std::string_view cookies) const {
    const PairedBrowser* found = desk_.find(token_in_cookies(cookies), now());
    return found == nullptr ? std::string{} : found->name;
}

void PairingDoor::note_order(std::string_view cookies) {
    if (desk_.note_order(token_in_cookies(cookies), now())) spawn(scheduler_, save_or_tell());
}

Task<Result<void>> PairingDoor::save() {
    if (file_.empty()) co_return Result<void>{};
    if (stopped_) co_return fail(Fault::not_durable, "the station is about to end");
    if (!writer_) writer_ = std::make_shared<WorkThread>();
    std::function<Result<void>()> job = [file = file_, paired = desk_.paired(now())] {
        return write_paired(file, paired);
    };
    co_return co_await on_thread<void>(writer_, scheduler_.executor(), std::move(job));
}

Task<void> PairingDoor::save_or_tell() {
    const Result<void> saved = co_await save();
    if (!saved)
        spdlog::warn("{} ({}): who is paired now has to be paired anew after a restart.",
                     saved.error().detail, saved.error().cause.message());
}

HttpResponse PairingDoor::offer(const HttpRequest& request,
                                const ConsoleConfig& config,
                                const std::string& no_way) {
    const auto name = pair_request_from_json(request.body());
    if (!name) return answer(request, name.error());
    const auto code = desk_.offer(*name, now());
    if (!code) return answer(request, code.error());
    if (!no_way.empty()) return answer(request, http::status::ok, offer_json(*code, "", no_way));
    const std::string page =
        page_address(config.host, config.port, config.allowed_hosts, config.speaks_tls());
    return answer(request, http::status::ok, offer_json(*code, page, advice_on(config)));
}

HttpResponse PairingDoor::list(const HttpRequest& request) const {
    return answer(request, http::status::ok, paired_json(desk_.paired(now())));
}

Task<HttpResponse> PairingDoor::end(HttpRequest request) {
    const auto order = end_request_from_json(request.body());
    if (!order) co_return answer(request, order.error());
    const std::size_t ended = order->name ? desk_.end_name(*order->name) : desk_.end_all();
    if (order->name && ended == 0)
        co_return answer(request, Error{Fault::not_found,
                                        "no paired browser is called '" + *order->name +
                                            "'; axiscal pair --list shows them",
                                        {},
                                        {}});
    spdlog::info("Pairing ended: {}, {}.", order->name ? *order->name : "all", ended);
    const Result<void> saved = co_await save();
    if (!saved)
        co_return answer(request, Error{Fault::not_durable,
                                        "Ended, but a restart of axiscald would pair them again: " +
                                            saved.error().detail,
                                        saved.error().cause,
                                        {}});
    co_return answer(request, http::status::ok, {{"ended", ended}});
}

HttpResponse PairingDoor::show_session(const HttpRequest& request) const {
    const std::string cookies = cookies_of(request);
    const PairedBrowser* browser = desk_.find(token_in_cookies(cookies), now());
    return answer(request, http::status::ok, session_json(browser));
}

Task<HttpResponse> PairingDoor::open_session(HttpRequest request, bool secure) {
    const auto digits = session_request_from_json(request.body());
    if (!digits) co_return answer(request, digits.error());
    const std::string before = cookies_of(request);
    const auto opened = desk_.open(*digits, now());
    if (!opened) co_return answer(request, opened.error());
    desk_.end_token(token_in_cookies(before)); // the browser forgets its earlier one
    spdlog::info("Paired: the browser \"{}\" may order. 'axiscal pair --end' ends that.",
                 opened->name);
    co_await save_or_tell();
    const PairedBrowser shown{{}, opened->name, opened->until_utc_ns - pairing_lasts.count()};
    co_return answer_with_cookie(request, session_json(&shown),
                                 set_cookie_text(opened->token, cookie_lasts, secure));
}

Task<HttpResponse> PairingDoor::close_session(HttpRequest request, bool secure) {
    const std::string cookies = cookies_of(request);
    if (desk_.end_token(token_in_cookies(cookies)) > 0) co_await save_or_tell();
    co_return answer_with_cookie(request, session_json(nullptr),
                                 set_cookie_text({}, cookie_lasts, secure));
}

} // namespace axiscal
