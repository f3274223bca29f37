#include "acquisition/console/event_clients.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr std::size_t row_of(EventTopic topic) {
    return static_cast<std::size_t>(topic);
}

} // namespace

std::optional<std::size_t> EventClients::enter(std::size_t stretches) {
    const auto free = std::ranges::find_if(clients_, [](const auto& at) { return !at; });
    if (free == clients_.end()) return std::nullopt;
    Client& client = free->emplace();
    client.stretches = stretches;
    client.has_news[row_of(EventTopic::status)] = true;
    client.has_news[row_of(EventTopic::points)] = true;
    client.has_news[row_of(EventTopic::stream)] = stretches > 0;
    return static_cast<std::size_t>(free - clients_.begin());
}

void EventClients::leave(std::size_t place) {
    clients_[place].reset();
}

void EventClients::news(EventTopic topic) {
    for (auto& client : clients_)
        if (client) client->has_news[row_of(topic)] = true;
}

void EventClients::news_of_stream(std::size_t stretches) {
    for (auto& client : clients_)
        if (client && client->stretches == stretches)
            client->has_news[row_of(EventTopic::stream)] = true;
}

void EventClients::no_news(std::size_t place, EventTopic topic) {
    if (clients_[place]) clients_[place]->has_news[row_of(topic)] = false;
}

EventClients::Turn EventClients::turn(std::size_t place, MonotonicTime now) const {
    const auto& client = clients_[place];
    if (!client || client->under_way) return {};
    std::optional<std::size_t> first;
    for (std::size_t topic = 0; topic < topics; ++topic)
        if (client->has_news[topic] && (!first || client->sent[topic] < client->sent[*first]))
            first = topic;
    if (!first) return {};
    if (client->last && now - *client->last < pace) return {{}, *client->last + pace};
    return {static_cast<EventTopic>(*first), {}};
}

void EventClients::hand_over(std::size_t place, EventTopic topic, MonotonicTime now) {
    auto& client = clients_[place];
    if (!client) return;
    client->has_news[row_of(topic)] = false;
    client->sent[row_of(topic)] = client->last = now;
    client->under_way = true;
}

void EventClients::taken(std::size_t place) {
    if (clients_[place]) clients_[place]->under_way = false;
}

bool EventClients::empty() const {
    return std::ranges::none_of(clients_, [](const auto& client) { return client.has_value(); });
}

std::set<std::size_t> EventClients::stretches() const {
    std::set<std::size_t> asked;
    for (const auto& client : clients_)
        if (client && client->stretches > 0) asked.insert(client->stretches);
    return asked;
}

std::vector<std::size_t> EventClients::waiting() const {
    std::vector<std::size_t> found;
    for (std::size_t place = 0; place < places; ++place) {
        const auto& client = clients_[place];
        if (client && !client->under_way && std::ranges::count(client->has_news, true) > 0)
            found.push_back(place);
    }
    return found;
}

std::vector<std::size_t> EventClients::overdue(MonotonicTime now) const {
    std::vector<std::size_t> found;
    for (std::size_t place = 0; place < places; ++place) {
        const auto& client = clients_[place];
        if (client && client->under_way && now - *client->last > patience) found.push_back(place);
    }
    return found;
}

} // namespace axiscal
