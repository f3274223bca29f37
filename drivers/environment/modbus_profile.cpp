#include "drivers/environment/modbus_profile.hpp"

#include "config/measure.hpp"
#include "config/settings.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace axiscal {
namespace {

/// A Modbus reply holds at most 125 registers.
constexpr int most_registers = 125;

struct UnitRow {
    std::string_view unit;
    ChannelKind kind;
    double scale, offset;
};
constexpr std::array unit_rows{
    UnitRow{"degC", ChannelKind::temperature, 1, 0},
    UnitRow{"degF", ChannelKind::temperature, 5.0 / 9, -160.0 / 9},
    UnitRow{"K", ChannelKind::temperature, 1, -273.15},
    UnitRow{"Pa", ChannelKind::pressure, 1, 0},
    UnitRow{"hPa", ChannelKind::pressure, 100, 0},
    UnitRow{"kPa", ChannelKind::pressure, 1000, 0},
    UnitRow{"%", ChannelKind::humidity, 1, 0},
    UnitRow{"ppm", ChannelKind::carbon_dioxide, 1, 0},
    UnitRow{"mm", ChannelKind::displacement, 1e-3, 0},
    UnitRow{"um", ChannelKind::displacement, 1e-6, 0},
};

std::vector<std::string> unit_names() {
    std::vector<std::string> names;
    names.reserve(unit_rows.size());
    for (const UnitRow& row : unit_rows)
        names.emplace_back(row.unit);
    return names;
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
    std::string text;
    for (const std::string& word : words) {
        if (!text.empty()) text += between;
        text += word;
    }
    return text;
}

WordType type_of(std::string_view name) {
    constexpr std::array names{"s16", "u16", "s32", "u32", "f32", "bcd", "bit"};
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? WordType::s16 : static_cast<WordType>(found - names.begin());
}

int width_of(WordType type) {
    const bool two = type == WordType::s32 || type == WordType::u32 || type == WordType::f32;
    return two ? 2 : 1;
}

/// @param lowest_function 3, or 1 where bits may be read
ModbusField read_field(Settings& table, int lowest_function = 3) {
    ModbusField field;
    field.function = static_cast<int>(table.integer("function", lowest_function, 4));
    field.address = static_cast<int>(table.integer("address", 0, 65535));
    field.type = field.function < 3
                     ? type_of(table.choice("type", {"bit"}, "bit"))
                     : type_of(table.choice("type", {"s16", "u16", "s32", "u32", "f32", "bcd"}));
    field.count = field.type == WordType::bcd ? static_cast<int>(table.integer("count", 1, 4, 1))
                                              : width_of(field.type);
    field.low_word_first = table.choice("word_order", {"high word first", "low word first"},
                                        "high word first") == "low word first";
    return field;
}

std::vector<double> read_invalid(Settings& table) {
    std::vector<double> numbers;
    for (const std::string& text : table.texts("invalid", std::vector<std::string>{})) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        if (text.empty() || *end != '\0')
            table.refuse("invalid", "\"" + text + "\" is no number");
        else
            numbers.push_back(value);
    }
    return numbers;
}

ModbusChannel read_channel(Settings& table) {
    ModbusChannel channel;
    channel.channel.name = table.text("name");
    const auto unit = table.choice("unit", unit_names());
    const auto row = std::ranges::find(unit_rows, unit, &UnitRow::unit);
    if (row != unit_rows.end()) {
        channel.channel.kind = row->kind;
        channel.stored_scale = row->scale;
        channel.stored_offset = row->offset;
    }
    const auto medium = table.choice("medium", {"air", "material", "none"});
    channel.channel.medium = medium == "air"        ? Medium::air
                             : medium == "material" ? Medium::material
                                                    : Medium::none;
    channel.field = read_field(table);
    channel.scale = table.number("scale", -1e6, 1e6, 1.0);
    channel.offset = table.number("offset", -1e6, 1e6, 0.0);
    channel.invalid = read_invalid(table);
    if (table.has("lowest")) channel.lowest = table.number("lowest", -1e9, 1e9);
    if (table.has("highest")) channel.highest = table.number("highest", -1e9, 1e9);
    return channel;
}

/// @param channels of the profile, all of which a setting concerns that names none
ModbusSetting read_setting(Settings& table, const std::vector<ModbusChannel>& channels) {
    ModbusSetting setting;
    setting.name = table.text("name");
    setting.field = read_field(table, 1);
    setting.must_be = table.number("must_be", -4294967295.0, 4294967295.0);
    std::vector<std::string> known;
    for (const ModbusChannel& channel : channels)
        known.push_back(channel.channel.name);
    for (const std::string& name : table.texts("channels", known)) {
        const auto found = std::ranges::find(known, name);
        if (found == known.end())
            table.refuse("channels", "\"" + name + "\" is no channel of this profile; known: " +
                                         joined(known, ", "));
        else
            setting.channels.push_back(static_cast<std::size_t>(found - known.begin()));
    }
    return setting;
}

LinkSettings read_line(Settings& root) {
    LinkSettings link;
    link.baud = static_cast<int>(root.integer("baud", 1200, 3'000'000, 9600));
    const auto parity = root.choice("parity", {"none", "even", "odd"}, "none");
    link.parity = parity == "even" ? 'E' : parity == "odd" ? 'O' : 'N';
    link.stop_bits = static_cast<int>(root.integer("stop_bits", 1, 2, 1));
    return link;
}

ModbusProfile read_profile(Settings root) {
    using std::chrono::milliseconds, std::chrono::seconds;
    ModbusProfile profile;
    profile.maker = root.text("maker");
    profile.model = root.text("model");
    profile.link = read_line(root);
    profile.unit_id = static_cast<int>(root.integer("unit_id", 0, 255, 1));
    profile.address_offset = static_cast<int>(root.integer("address_offset", -1, 1, 0));
    profile.poll_period =
        root.duration("poll_period", milliseconds{20}, seconds{600}, milliseconds{1000});
    profile.gap = root.duration("gap", milliseconds{0}, seconds{1}, milliseconds{5});
    profile.timeout = root.duration("timeout", milliseconds{20}, seconds{5}, milliseconds{500});
    for (Settings& table : root.tables("channel"))
        profile.channels.push_back(read_channel(table));
    if (profile.channels.empty()) root.refuse("channel", "a profile has at least one [[channel]]");
    for (Settings& table : root.tables("setting"))
        profile.settings.push_back(read_setting(table, profile.channels));
    if (root.has("serial_number")) {
        Settings table = root.table("serial_number");
        profile.serial_number = read_field(table);
    }
    return profile;
}

std::optional<double> decode_bcd(std::span<const std::uint16_t> words) {
    double value = 0;
    for (const unsigned word : words)
        for (const unsigned shift : {12u, 8u, 4u, 0u}) {
            const unsigned digit = (word >> shift) & 15u;
            if (digit > 9) return std::nullopt;
            value = value * 10 + digit;
        }
    return value;
}

std::vector<std::string> profiles_in(const std::vector<std::string>& folders) {
    std::vector<std::string> names;
    for (const std::string& folder : folders) {
        std::error_code missing;
        for (const auto& entry : std::filesystem::directory_iterator{folder, missing})
            if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
    std::ranges::sort(names);
    return names;
}

} // namespace

std::optional<double> decode_words(std::span<const std::uint16_t> words, const ModbusField& field) {
    if (words.size() != static_cast<std::size_t>(field.count)) return std::nullopt;
    if (field.type == WordType::bcd) return decode_bcd(words);
    if (field.type == WordType::u16 || field.type == WordType::bit) return words[0];
    if (field.type == WordType::s16) return static_cast<std::int16_t>(words[0]);
    const std::uint32_t high = words[field.low_word_first ? 1 : 0];
    const std::uint32_t both = (high << 16) | words[field.low_word_first ? 0 : 1];
    if (field.type == WordType::u32) return both;
    if (field.type == WordType::s32) return static_cast<std::int32_t>(both);
    const double value = static_cast<double>(std::bit_cast<float>(both));
    return std::isfinite(value) ? std::optional{value} : std::nullopt;
}

std::optional<double> channel_value(std::span<const std::uint16_t> words,
                                    const ModbusChannel& channel) {
    const auto raw = decode_words(words, channel.field);
    if (!raw || std::ranges::find(channel.invalid, *raw) != channel.invalid.end())
        return std::nullopt;
    const double in_unit = *raw * channel.scale + channel.offset;
    if (channel.lowest && in_unit < *channel.lowest) return std::nullopt;
    if (channel.highest && in_unit > *channel.highest) return std::nullopt;
    return in_unit * channel.stored_scale + channel.stored_offset;
}

std::vector<RegisterBlock> register_blocks(const std::vector<ModbusField>& fields) {
    std::vector<std::size_t> order(fields.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    const auto place = [&](std::size_t i) {
        return std::pair{fields[i].function, fields[i].address};
    };
    std::ranges::stable_sort(order, {}, place);
    std::vector<RegisterBlock> blocks;
    for (const std::size_t i : order) {
        const ModbusField& field = fields[i];
        const bool joins = !blocks.empty() && blocks.back().function == field.function &&
                           field.address <= blocks.back().address + blocks.back().count &&
                           field.address + field.count - blocks.back().address <= most_registers;
        if (!joins) blocks.push_back({field.function, field.address, 0, {}});
        RegisterBlock& block = blocks.back();
        block.count = std::max(block.count, field.address + field.count - block.address);
        block.places.push_back(i);
    }
    return blocks;
}

std::vector<ModbusField> channel_fields(const ModbusProfile& profile) {
    std::vector<ModbusField> fields;
    for (const ModbusChannel& channel : profile.channels)
        fields.push_back(channel.field);
    return fields;
}

std::vector<ModbusField> setting_fields(const ModbusProfile& profile) {
    std::vector<ModbusField> fields;
    for (const ModbusSetting& setting : profile.settings)
        fields.push_back(setting.field);
    return fields;
}

std::span<const std::uint16_t> words_of(const RegisterBlock& block,
                                        std::span<const std::uint16_t> words,
                                        const ModbusField& field) {
    return words.subspan(static_cast<std::size_t>(field.address - block.address),
                         static_cast<std::size_t>(field.count));
}

Result<ModbusProfile> load_profile(const std::string& path) {
    AXISCAL_TRY(auto document, SettingsDocument::load(path));
    ModbusProfile profile = read_profile(document.root());
    const auto refusals = document.finish();
    if (refusals.empty()) return profile;
    std::vector<std::string> reasons;
    reasons.reserve(refusals.size());
    for (const Refusal& refusal : refusals)
        reasons.push_back(refusal.describe());
    return fail(Fault::bad_configuration, joined(reasons, "; "));
}

Result<std::string> find_profile(const std::string& name, const std::vector<std::string>& folders) {
    if (name.find('/') != std::string::npos || name.ends_with(".toml")) return name;
    for (const std::string& folder : folders) {
        const std::filesystem::path path = std::filesystem::path{folder} / (name + ".toml");
        std::error_code missing;
        if (std::filesystem::exists(path, missing)) return path.string();
    }
    const std::vector<std::string> known = profiles_in(folders);
    const std::string near = nearest_word(name, known);
    return fail(Fault::not_found, "there is no profile \"" + name + "\" in " +
                                      joined(folders, ":") + "; known: " + joined(known, ", ") +
                                      (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
}

std::vector<std::string> profile_folders() {
    std::vector<std::string> folders;
    // Read while the station file is read, before any thread exists.
    const char* const stated = std::getenv("AXISCAL_PROFILE_PATH"); // NOLINT(concurrency-mt-unsafe)
    std::string_view rest = stated ? stated : "";
    while (!rest.empty()) {
        const auto folder = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
        if (!folder.empty()) folders.emplace_back(folder);
    }
    // Beside the program, wherever it was installed; nothing of the build is remembered.
    std::error_code unreadable;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", unreadable);
    folders.push_back(
        (program.parent_path() / "../share/axiscal/profiles").lexically_normal().string());
    return folders;
}

} // namespace axiscal
