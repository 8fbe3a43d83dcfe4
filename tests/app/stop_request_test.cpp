#include "app/stop_request.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include "app/human_text.hpp"

namespace scree::app {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

std::filesystem::path stop_file() {
    return std::filesystem::path(testing::TempDir()) / "stop_now";
}

TEST(StopRequest, NothingAsked) {
    StopRequest stop(stop_file(), kNone);
    EXPECT_EQ(stop.cause(100.0), StopCause::none);
}

TEST(StopRequest, SignalsAreNotedAndHandlersPutBack) {
    for (const auto& [signal, name] : {std::pair{SIGUSR1, "SIGUSR1"}, {SIGTERM, "SIGTERM"}, {SIGINT, "SIGINT"}}) {
        StopRequest stop(stop_file(), kNone);
        std::raise(signal);
        EXPECT_NE(stop.reason(stop.cause(0.0)).find(name), std::string::npos);
    }
    struct sigaction now {};
    sigaction(SIGTERM, nullptr, &now);
    EXPECT_EQ(now.sa_handler, SIG_DFL);
}

TEST(StopRequest, WhatTheCallerIgnoresStaysIgnored) {
    std::signal(SIGHUP, SIG_IGN);
    {
        StopRequest stop(stop_file(), kNone);
        std::raise(SIGHUP);
        EXPECT_EQ(stop.cause(0.0), StopCause::none);
    }
    std::signal(SIGHUP, SIG_DFL);
}

TEST(StopRequestDeathTest, ASecondInterruptEndsTheProgram) {
    EXPECT_EXIT(
        {
            StopRequest stop(stop_file(), kNone);
            std::raise(SIGINT);
            std::raise(SIGINT);
        },
        testing::KilledBySignal(SIGINT), "");
}

TEST(StopRequest, TheFileIsObeyedAndRemoved) {
    StopRequest stop(stop_file(), kNone);
    std::ofstream(stop_file()).put('\n');
    EXPECT_EQ(stop.cause(0.0), StopCause::file);
    EXPECT_FALSE(std::filesystem::exists(stop_file()));
    EXPECT_EQ(stop.cause(0.0), StopCause::none);  // looked for again only half a second later
}

TEST(StopRequest, TimeIsKeptForTwoCheckpoints) {
    StopRequest stop(stop_file(), 100.0);
    EXPECT_EQ(stop.cause(0.0), StopCause::none);
    EXPECT_EQ(stop.cause(40.0), StopCause::none);
    EXPECT_EQ(stop.cause(49.5), StopCause::wall_time);
    EXPECT_NE(stop.reason(StopCause::wall_time).find("wall-time limit"), std::string::npos);
}

TEST(StopRequest, OtherRanksLeaveFileAndClockToTheFirst) {
    StopRequest stop(stop_file(), 0.0, false);
    std::ofstream(stop_file()).put('\n');
    EXPECT_EQ(stop.cause(0.0), StopCause::none);
    EXPECT_TRUE(std::filesystem::remove(stop_file()));
    std::raise(SIGUSR1);
    EXPECT_EQ(stop.cause(0.0), StopCause::user_signal);
}

TEST(StopRequest, TheEndOfASlurmJobIsALimit) {
    unsetenv("SLURM_JOB_END_TIME");
    EXPECT_EQ(wall_limit(std::nullopt), kNone);
    EXPECT_EQ(wall_limit(50.0), 50.0);
    setenv("SLURM_JOB_END_TIME", std::to_string(std::time(nullptr) + 1000).c_str(), 1);
    EXPECT_NEAR(wall_limit(std::nullopt), 1000.0, 2.0);
    EXPECT_EQ(wall_limit(50.0), 50.0);
    EXPECT_NEAR(wall_limit(5000.0), 1000.0, 2.0);
    setenv("SLURM_JOB_END_TIME", "soon", 1);
    EXPECT_EQ(wall_limit(50.0), 50.0);
    unsetenv("SLURM_JOB_END_TIME");
}

}  // namespace
}  // namespace scree::app
