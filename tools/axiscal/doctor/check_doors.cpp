// Who may ask the daemon, and the ports at which it listens.
#include "config/version.hpp"
#include "tools/axiscal/doctor/doctor.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <algorithm>
#include <unistd.h>

namespace axiscal {
namespace {

using boost::asio::ip::tcp;

PortTrial trial_of(const boost::system::error_code& error) {
    if (!error) return PortTrial::free;
    if (error == boost::asio::error::address_in_use) return PortTrial::taken;
    if (error == boost::asio::error::access_denied) return PortTrial::no_right;
    if (error == std::errc::address_not_available) return PortTrial::no_address;
    return PortTrial::failed;
}

/// Binds as the daemon will, and lets go again.
PortTrial try_port(const std::string& host, int port) {
    boost::system::error_code error;
    const auto address = boost::asio::ip::make_address(host, error);
    if (error) return PortTrial::failed;
    boost::asio::io_context loop;
    const tcp::endpoint where{address, static_cast<std::uint16_t>(port)};
    tcp::acceptor acceptor{loop};
    acceptor.open(where.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address{true}, error);
    if (!error) acceptor.bind(where, error);
    if (!error) acceptor.listen(1, error);
    return trial_of(error);
}

Finding check_allowed(const TriggerConfig& trigger) {
    if (is_loopback(trigger.host))
        return {
            Health::note, "port",
            "the CNC's Modbus port accepts connections from this PC only: that is correct if the "
            "CNC runs on this PC",
            "for a CNC on the network, write this PC's address as trigger.host, and the CNC's "
            "address in allowed_clients"};
    return {Health::good, "port",
            std::to_string(trigger.allowed_clients.size()) +
                " addresses or networks may connect to the CNC's Modbus port",
            ""};
}

/// A console that hears this PC alone is the usual one and worth no line.
std::optional<Finding> check_readers(const ConsoleConfig& console) {
    if (is_loopback(console.host)) return std::nullopt;
    return Finding{Health::good, "port",
                   std::to_string(console.allowed_clients.size()) +
                       " addresses or networks may read at the console's port",
                   ""};
}

bool is_member(const std::string& name) {
    const std::vector<gid_t> groups = own_groups();
    const auto wanted = group_named(name);
    return wanted && std::ranges::find(groups, *wanted) != groups.end();
}

/// An update does not restart a daemon that was started by hand.
Finding check_answer(const std::string& version) {
    if (version.empty() || version == software_version())
        return {Health::good, "rights", "axiscald answers at its socket", ""};
    return {Health::note, "rights",
            "axiscald answers as version " + version + ", and this is axiscal " +
                software_version(),
            "sudo systemctl restart axiscald axiscal-publish; an open run goes on by itself"};
}

} // namespace

std::vector<Finding> check_account(const CheckedSystem& checked) {
    std::vector<Finding> found;
    if (!checked.service.is_service)
        found.push_back({Health::note, "rights",
                         "there is no user axiscal: it is not installed as a service here",
                         "tools/install"});
    const std::string group =
        checked.config != nullptr ? checked.config->console.group : ConsoleConfig{}.group;
    if (!group.empty() && !group_named(group))
        found.push_back({Health::broken, "rights", "there is no group " + group,
                         "sudo systemd-sysusers axiscal.conf"});
    else if (!group.empty() && ::geteuid() != 0 && !is_member(group))
        found.push_back({Health::note, "rights",
                         "this user is not in the group " + group + ": it may not arm and abort",
                         "sudo adduser \"$USER\" " + group + ", then log in again"});
    else
        found.push_back({Health::good, "rights", "this user may arm and abort", ""});
    if (checked.daemon_answers)
        found.push_back(check_answer(checked.daemon_version));
    else
        found.push_back(
            {Health::note, "rights", "axiscald does not answer at its socket",
             "sudo systemctl start axiscald; journalctl -u axiscald shows why it ended"});
    return found;
}

std::vector<Finding> check_ports(const CheckedSystem& checked) {
    std::vector<Finding> found;
    const TriggerConfig& trigger = checked.config->trigger;
    if (trigger.transport == TriggerTransport::tcp_server) {
        found.push_back(judge_port_trial({"the CNC's Modbus port", trigger.host, trigger.port,
                                          try_port(trigger.host, trigger.port),
                                          checked.daemon_answers, ::geteuid() == 0}));
        found.push_back(check_allowed(trigger));
    }
    const ConsoleConfig& console = checked.config->console;
    if (console.port > 0) {
        found.push_back(judge_port_trial({"the console's port", console.host, console.port,
                                          try_port(console.host, console.port),
                                          checked.daemon_answers, ::geteuid() == 0}));
        if (auto readers = check_readers(console)) found.push_back(*std::move(readers));
    }
    if (!checked.trigger_note.empty())
        found.push_back({Health::note, "port",
                         "axiscald reports about its trigger: " + checked.trigger_note,
                         "axiscal status"});
    return found;
}

} // namespace axiscal
