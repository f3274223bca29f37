#include "acquisition/console/http_orders.hpp"

#include "acquisition/console/api_json.hpp"
#include "acquisition/console/peer.hpp"

#include <boost/asio/use_awaitable.hpp>
#include <nlohmann/json.hpp>

#include <utility>

namespace axiscal {
namespace {

namespace http = boost::beast::http;

} // namespace

Task<HttpResponse>
arm_by_request(StationInterface& station, HttpRequest request, Orderer by, int descriptor) {
    auto wanted = arm_request_from_json(request.body());
    if (!wanted) co_return answer(request, wanted.error());
    ArmRequest order = *std::move(wanted);
    by.name = order.by.name;
    order.by = std::move(by);
    order.has_gone = [descriptor] { return has_hung_up(descriptor); };
    ArmRequest asked = order;
    const auto run = co_await station.arm(std::move(asked));
    if (!run && run.error().field == "preflight") {
        const auto checks = co_await station.preflight(std::move(order));
        co_return answer_with_checks(request, run.error(), checks);
    }
    if (!run) co_return answer(request, run.error());
    co_return answer(request, http::status::created, {{"run", *run}});
}

Task<HttpResponse> revise_by_request(StationInterface& station, HttpRequest request, Orderer by) {
    auto wanted = revision_request_from_json(request.body());
    if (!wanted) co_return answer(request, wanted.error());
    RevisionRequest order = *std::move(wanted);
    by.name = order.by.name;
    order.by = std::move(by);
    if (asked_path(request) == "/v1/run/retake") {
        const auto retake = co_await station.retake(std::move(order));
        if (!retake) co_return answer(request, retake.error());
        co_return answer(request, http::status::ok, to_json(*retake));
    }
    const auto excluded = co_await station.exclude(std::move(order));
    if (!excluded) co_return answer(request, excluded.error());
    co_return answer(request, http::status::ok, {{"excluded", *excluded}});
}

Task<HttpResponse> answer_by_request(StationInterface& station, HttpRequest request, Orderer by) {
    auto wanted = answer_request_from_json(request.body());
    if (!wanted) co_return answer(request, wanted.error());
    AnswerRequest order = *std::move(wanted);
    by.name = order.by.name;
    order.by = std::move(by);
    const auto kept = co_await station.answer_finding(std::move(order));
    if (!kept) co_return answer(request, kept.error());
    co_return answer(request, http::status::ok, {{"answer", "kept"}});
}

} // namespace axiscal
