// Who is told: the secret, what waits, and what axiscal-notify says about it. Nothing is sent.
#include "acquisition/events/event_folder.hpp"
#include "acquisition/events/webhook_signature.hpp"
#include "analysis/quantity/counted.hpp"
#include "tools/axiscal/doctor/doctor.hpp"

namespace axiscal {
namespace {

Finding check_webhook_secret(const WebhookConfig& webhook) {
    const auto keys = read_webhook_secret(webhook.secret_file);
    if (keys)
        return {Health::good, "webhook", "the secret in " + webhook.secret_file + " is one", ""};
    if (keys.error().cause == std::errc::permission_denied)
        return {Health::note, "webhook",
                "the secret was not looked at: this user may not read " + webhook.secret_file,
                "sudo axiscal doctor"};
    return {Health::broken, "webhook", "nothing can be signed: " + describe(keys.error()),
            "docs/webhook.md says how a secret is made"};
}

Finding check_waiting_events(const std::string& state_directory, const WebhookConfig& webhook) {
    const auto waiting = waiting_events(state_directory).size();
    const std::string trouble = event_trouble(state_directory);
    if (waiting == 0) return {Health::good, "webhook", "nothing waits for " + webhook.place, ""};
    const std::string words =
        counted(static_cast<long>(waiting), "event") + " for " + webhook.place;
    if (!trouble.empty())
        return {Health::broken, "webhook", words + " not delivered: " + trouble,
                "journalctl -u axiscal-notify tells since when; it is tried again by itself"};
    return {Health::note, "webhook", words + " not delivered yet",
            "sudo systemctl enable --now axiscal-notify.path"};
}

} // namespace

std::vector<Finding> check_webhook(const CheckedSystem& checked) {
    const StationConfig& config = *checked.config;
    if (!config.webhook) return {};
    std::vector<Finding> found{check_webhook_secret(*config.webhook),
                               check_waiting_events(config.state_directory, *config.webhook)};
    if (const auto dropped = dropped_events(config.state_directory); dropped > 0)
        found.push_back(
            {Health::note, "webhook",
             counted(dropped, "event") + " dropped: more than " +
                 std::to_string(most_waiting_events) + " waited",
             "look at the receiver, then: sudo rm " + config.state_directory + "/events/dropped"});
    return found;
}

} // namespace axiscal
