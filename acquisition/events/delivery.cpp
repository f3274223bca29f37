#include "acquisition/events/delivery.hpp"

#include "acquisition/events/event_folder.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace axiscal {
namespace {

constexpr std::array<Duration, 4> pauses{std::chrono::seconds{5}, std::chrono::seconds{30},
                                         std::chrono::minutes{2}, std::chrono::minutes{5}};
constexpr Duration longest_asked_pause = std::chrono::hours{1};
constexpr double by_chance = 0.2;
constexpr int too_many_requests = 429, unavailable = 503;

bool is_success(int status) {
    return status >= 200 && status < 300;
}

} // namespace

EventDelivery::EventDelivery(std::string state_directory,
                             std::vector<WebhookKey> keys,
                             DeliveryParts parts)
    : state_directory_{std::move(state_directory)}
    , keys_{std::move(keys)}
    , parts_{std::move(parts)} {}

std::size_t EventDelivery::pass() {
    trouble_.clear();
    asked_pause_.reset();
    const std::size_t before = delivered_;
    for (const std::string& id : waiting_events(state_directory_))
        if (!goes_on() || attempt(id) == Outcome::away) break;
    passes_in_vain_ = delivered_ > before ? 0 : passes_in_vain_ + 1;
    tell_event_trouble(state_directory_, trouble_);
    return waiting_events(state_directory_).size();
}

EventDelivery::Outcome EventDelivery::attempt(const std::string& id) {
    auto body = waiting_body(state_directory_, id);
    if (!body) { // dropped meanwhile, or this user may not read it: no reason to come back at once
        trouble_ = describe(body.error());
        return Outcome::refused;
    }
    WebhookPost post{id, "", *std::move(body), parts_.utc_s()};
    post.signatures = webhook_signatures(keys_, id, post.utc_s, post.body);
    return judge(id, parts_.post(post));
}

EventDelivery::Outcome EventDelivery::judge(const std::string& id, const WebhookAnswer& answer) {
    if (is_success(answer.status)) {
        const auto settled = settle_event(state_directory_, id);
        if (settled) ++delivered_;
        if (!settled) trouble_ = describe(settled.error());
        return settled ? Outcome::taken : Outcome::away; // not again and again on a full disk
    }
    if (answer.status == 0) {
        trouble_ = "the receiver gave no answer: " + answer.trouble;
        return Outcome::away;
    }
    trouble_ = "the receiver answered " + std::to_string(answer.status) + " to " + id;
    asked_pause_ = answer.retry_after;
    const bool asks_for_time =
        answer.status == too_many_requests || answer.status == unavailable || answer.retry_after;
    return asks_for_time ? Outcome::away : Outcome::refused;
}

Duration EventDelivery::pause() {
    const std::size_t step = std::min(std::max(passes_in_vain_, std::size_t{1}), pauses.size()) - 1;
    Duration pause = pauses.at(step);
    if (asked_pause_) pause = std::max(pause, std::min(*asked_pause_, longest_asked_pause));
    const double more = static_cast<double>(pause.count()) * by_chance * parts_.chance();
    return pause + Duration{static_cast<Duration::rep>(more)};
}

} // namespace axiscal
