#include "app/progress.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

namespace scree::app {
namespace {

ProgressFigures figures() {
    ProgressFigures f;
    f.time = 0.5;
    f.end = 2.0;
    f.step = 500;
    f.steps = 2000;
    f.report.bodies = 10000;
    f.report.contacts = 28012;
    f.report.sweeps = 14;
    f.report.residual_rms = 8.2e-3;
    f.report.penetration.max_relative = 3e-4;
    f.speed = 20.0;
    return f;
}

// What a console writes, caught in a pipe.
class Capture {
  public:
    Capture() { EXPECT_EQ(pipe(ends_), 0); }
    ~Capture() { close(ends_[0]); }
    int descriptor() const { return ends_[1]; }
    std::string text() {
        close(ends_[1]);
        std::string all;
        char buffer[4096];
        for (ssize_t n; (n = read(ends_[0], buffer, sizeof buffer)) > 0;)
            all.append(buffer, static_cast<std::size_t>(n));
        return all;
    }

  private:
    int ends_[2] = {-1, -1};
};

TEST(Progress, TheLineSaysWhereTheRunIs) {
    EXPECT_EQ(
        live_text(figures(), 200),
        "25.0 % | t 0.5 s | 30 s left | 20 s/s | 28 012 contacts | residual 8.2e-03 | 14 sweeps | overlap 3.0e-04 d "
        "| 10 000 bodies | step 500");
    EXPECT_EQ(plain_text(figures()),
              "25.0 %, t = 0.5 of 2 s, step 500 of 2000, 10000 bodies, 28012 contacts, 14 sweeps, residual 8.2e-03, "
              "overlap 3.0e-04 d, 20 s a simulated second, 30 s left");
}

TEST(Progress, WhatDoesNotFitIsLeftOutWhole) {
    EXPECT_EQ(live_text(figures(), 45), "25.0 % | t 0.5 s | 30 s left | 20 s/s");
    for (int width = 1; width < 150; ++width) {
        EXPECT_LT(live_text(figures(), width).size(), static_cast<std::size_t>(width));
    }
}

TEST(Progress, SpeedComesFromTheLastHalfMinute) {
    SpeedMeter meter;
    EXPECT_EQ(meter.speed(), 0.0);
    meter.add(0.0, 0.0);
    EXPECT_EQ(meter.speed(), 0.0);
    for (int i = 1; i <= 100; ++i) meter.add(i, 0.1 * i);  // 10 s a simulated second
    EXPECT_NEAR(meter.speed(), 10.0, 1e-9);
    for (int i = 1; i <= 40; ++i) meter.add(100 + i, 10.0 + 0.01 * i);  // then 100
    EXPECT_NEAR(meter.speed(), 100.0, 1e-6);
}

TEST(Console, NoEscapesWhereThereIsNoTerminal) {
    Capture capture;
    {
        Console console(Loudness::normal, capture.descriptor(), false, false, 80);
        console.info("hello");
        console.live("25 %");
        console.detail("not shown");
        console.warning("careful");
        EXPECT_EQ(console.warnings(), std::vector<std::string>{"careful"});
    }
    EXPECT_EQ(capture.text(), "hello\nwarning: careful\n");
}

TEST(Console, OnATerminalTheLineIsRewrittenAndMessagesReplaceIt) {
    Capture capture;
    {
        Console console(Loudness::normal, capture.descriptor(), true, true, 10);
        console.live("a line that is too long");
        console.warning("careful");
        console.live("25 %");
    }
    EXPECT_EQ(capture.text(), "\r\x1b[Ka line th\r\x1b[K\x1b[33mwarning: \x1b[0mcareful\n\r\x1b[K25 %\n");
}

TEST(Console, QuietKeepsWarningsAndErrors) {
    Capture capture;
    {
        Console console(Loudness::quiet, capture.descriptor(), true, false, 80);
        console.info("hello");
        console.live("25 %");
        console.error("broken");
    }
    EXPECT_EQ(capture.text(), "error: broken\n");
}

TEST(Console, ABrokenPipeIsIgnored) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    close(ends[0]);
    signal(SIGPIPE, SIG_IGN);
    Console console(Loudness::normal, ends[1], false, false, 80);
    console.info("nobody listens");
    close(ends[1]);
    signal(SIGPIPE, SIG_DFL);
}

}  // namespace
}  // namespace scree::app
