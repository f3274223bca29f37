#pragma once
// A machine of words: notes what a program asks of it.

#include "cnc/machine_actions.hpp"

#include <map>
#include <sstream>
#include <vector>

namespace axiscal::simulate {

struct RecordingMachine final : MachineActions {
    void move(double target_mm, double feed) override { note("move", target_mm, feed); }
    void dwell(double seconds) override { note("dwell", seconds); }
    void set_analog(int output, double value) override { note("analog", output, value); }
    void set_digital(int output, bool on) override { note("digital", output, on ? 1 : 0); }
    bool wait_input(int number, bool high, double timeout_s) override {
        note(high ? "wait high" : "wait low", number, timeout_s);
        return answers;
    }
    bool input(int) override { return answers; }
    void message(const std::string& text) override { log.push_back(text); }
    void at_line(int number) override { line = number; }
    bool stopped() override { return false; }

    template <class... Numbers> void note(const std::string& word, Numbers... numbers) {
        std::ostringstream text;
        text << word;
        ((text << ' ' << numbers), ...);
        log.push_back(text.str());
    }

    std::vector<std::string> log;
    bool answers = true;
    int line = 0;
};

} // namespace axiscal::simulate
