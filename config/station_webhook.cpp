// [webhook]: who is told that a run is complete or that something is wrong with one.
#include "config/station_readers.hpp"
#include "config/webhook_address.hpp"

namespace axiscal {
namespace {

void read_webhook_kinds(Settings& table, WebhookConfig& config) {
    const std::vector<std::string> both{"complete", "fault"};
    const auto kinds = table.texts("on", both);
    config.on_complete = config.on_fault = false;
    for (const std::string& kind : kinds) {
        if (kind == "complete")
            config.on_complete = true;
        else if (kind == "fault")
            config.on_fault = true;
        else
            table.refuse("on", "\"" + kind + "\" is none: \"complete\", \"fault\" or both");
    }
    if (kinds.empty() && !table.refused("on"))
        table.refuse("on", "is empty: write [\"complete\", \"fault\"], or remove [webhook]");
}

void take_address(Settings& table, StationConfig& station, WebhookConfig& config) {
    if (table.refused("url")) return;
    const auto address = parse_webhook_address(config.url);
    if (!address) return table.refuse("url", address.error().detail);
    config.place = address->place;
    if (!address->encrypted)
        station.warnings.push_back(
            {station.file, table.line_of("url"), "webhook.url",
             "whoever sees the network reads along: the signature holds, and "
             "the content is open. https:// closes it"});
    if (!address->encrypted && !config.ca_file.empty())
        table.refuse("ca_file", "belongs to an https:// address");
}

} // namespace

void read_webhook(Settings root, StationConfig& station) {
    const bool stated = root.has("webhook");
    Settings table = root.table("webhook");
    if (!stated) {
        for (const char* key : {"url", "secret_file", "ca_file"})
            table.text(key, ""); // known, also where there is none
        table.texts("on", std::vector<std::string>{});
        return;
    }
    WebhookConfig config;
    config.line = table.line();
    config.url = table.text("url");
    config.secret_file = read_absolute_path(table, "secret_file");
    if (table.text("ca_file", "") != "") config.ca_file = read_absolute_path(table, "ca_file");
    read_webhook_kinds(table, config);
    take_address(table, station, config);
    station.webhook = std::move(config);
}

} // namespace axiscal
