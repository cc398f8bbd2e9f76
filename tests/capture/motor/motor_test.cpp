#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <turnscan/capture/motor/motor.hpp>

#include "tests/capture/simulated_table.hpp"

namespace turnscan {
namespace {

using testing::BoardFault;
using testing::BoardKind;
using ::testing::HasSubstr;
using testing::SimulatedTable;

constexpr double kDeg = std::numbers::pi / 180.0;

MotorOptions quick() {
  MotorOptions options;
  options.timeout_s = 0.4;
  options.boot_s = 0.02;
  return options;
}

const char* name_of(BoardKind kind) {
  constexpr std::array kNames{"Text", "Grbl", "GrblHal", "FluidNcTcp", "Marlin", "MarlinTcp"};
  return kNames[std::size_t(kind)];
}

const auto kBoards =
    ::testing::Values(BoardKind::kText, BoardKind::kGrbl, BoardKind::kGrblHal, BoardKind::kFluidNc,
                      BoardKind::kMarlin, BoardKind::kMarlinTcp);

class AnyBoard : public ::testing::TestWithParam<BoardKind> {};
INSTANTIATE_TEST_SUITE_P(Motor, AnyBoard, kBoards,
                         [](const auto& test) { return name_of(test.param); });

TEST_P(AnyBoard, RotatesByAnAngleAndStandsThere) {
  SimulatedTable table(GetParam(), BoardFault::kNone);
  auto motor = Motor::open(table.port(), quick(), RunContext());
  ASSERT_TRUE(motor) << motor.error().text();
  ASSERT_TRUE(motor->rotate(30.0 * kDeg, 80.0 * kDeg, RunContext()));
  EXPECT_NEAR(table.angle_deg(), 30.0, 0.01);
  ASSERT_TRUE(motor->rotate(-10.0 * kDeg, 80.0 * kDeg, RunContext()));
  EXPECT_NEAR(table.angle_deg(), 20.0, 0.01);
  EXPECT_FALSE(table.turning());
  const auto status = motor->status();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->state, MotorState::kIdle);
  EXPECT_NEAR(status->angle_rad, 20.0 * kDeg, 0.01 * kDeg);
}

TEST_P(AnyBoard, SpinsUntilItIsStopped) {
  SimulatedTable table(GetParam(), BoardFault::kNone);
  auto motor = Motor::open(table.port(), quick(), RunContext());
  ASSERT_TRUE(motor);
  ASSERT_TRUE(motor->spin(-60.0 * kDeg));
  for (int i = 0; i < 60; ++i) {  // longer than the pieces that a G-code board is given
    const auto good = motor->watch();
    ASSERT_TRUE(good) << good.error().text();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_TRUE(table.turning());
  EXPECT_LT(table.angle_deg(), -120.0);
  ASSERT_TRUE(motor->stop());
  EXPECT_FALSE(table.turning());
  EXPECT_TRUE(motor->rotate(5.0 * kDeg, 80.0 * kDeg, RunContext()));
}

TEST_P(AnyBoard, StopsByItselfWhenNobodyWatches) {
  SimulatedTable table(GetParam(), BoardFault::kNone);
  auto motor = Motor::open(table.port(), quick(), RunContext());
  ASSERT_TRUE(motor->spin(20.0 * kDeg));
  EXPECT_TRUE(table.turning());
  EXPECT_TRUE(table.stands_within(4.0));
}

TEST_P(AnyBoard, TheDestructorStopsTheTable) {
  SimulatedTable table(GetParam(), BoardFault::kNone);
  {
    auto motor = Motor::open(table.port(), quick(), RunContext());
    ASSERT_TRUE(motor->spin(20.0 * kDeg));
    EXPECT_TRUE(table.turning());
  }
  EXPECT_TRUE(table.stands_within(0.3));
}

TEST_P(AnyBoard, CancellingStopsTheTable) {
  SimulatedTable table(GetParam(), BoardFault::kNone);
  auto motor = Motor::open(table.port(), quick(), RunContext());
  const RunContext context;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    context.cancel();
  });
  const auto done = motor->rotate(180.0 * kDeg, 20.0 * kDeg, context);
  later.join();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kCancelled);
  EXPECT_TRUE(table.stands_within(0.3));
}

TEST_P(AnyBoard, ReversedTurnsTheOtherWay) {
  SimulatedTable table(GetParam(), BoardFault::kNone);
  MotorOptions options = quick();
  options.reversed = true;
  auto motor = Motor::open(table.port(), options, RunContext());
  ASSERT_TRUE(motor->rotate(10.0 * kDeg, 80.0 * kDeg, RunContext()));
  EXPECT_NEAR(table.angle_deg(), -10.0, 0.01);
  EXPECT_NEAR(motor->status()->angle_rad, 10.0 * kDeg, 0.01 * kDeg);
}

TEST_P(AnyBoard, RefusesSpeedsThatAreTooFastOrNone) {
  SimulatedTable table(GetParam(), BoardFault::kNone);
  auto motor = Motor::open(table.port(), quick(), RunContext());
  for (const double speed : {0.0, 100.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(motor->spin(speed).error().code, ErrorCode::kInvalidOption) << speed;
  EXPECT_FALSE(table.was_told_to_turn());
}

/// What a misbehaviour must lead to: words of the message, or that all goes on well.
struct Outcome {
  BoardFault fault;
  const char* name;
  const char* text;  ///< nullptr: it does no harm
  const char* gcode;
};
void PrintTo(const Outcome& outcome, std::ostream* out) { *out << outcome.name; }

constexpr Outcome kOutcomes[] = {
    {BoardFault::kLate, "Late", "did not answer", "did not answer"},
    {BoardFault::kGarbled, "Garbled", "did not answer", "did not answer"},
    {BoardFault::kStalls, "Stalls", "stalled", "stalled"},
    {BoardFault::kDisappears, "Disappears", "is gone", "is gone"},
    {BoardFault::kWrongReply, "WrongReply", "not understood", "did not answer"},
    {BoardFault::kHalfLine, "HalfLine", "half a line", "half a line"},
    {BoardFault::kTwice, "Twice", nullptr, nullptr},
    {BoardFault::kAlarm, "Alarm", "too hot", "the table reports"},
    {BoardFault::kRestarts, "Restarts", "restarted", "restarted"},
    {BoardFault::kEcho, "Echo", nullptr, nullptr},
    {BoardFault::kEndless, "Endless", "without end", "without end"},
    {BoardFault::kSilent, "Silent", "nothing came", "nothing came"},
    {BoardFault::kStops, "Stops", "stopped by itself", "stopped by itself"},
};

/// Spins for as long as a stall takes to show.
Result<> spin_for_a_while(Motor& motor) {
  TURNSCAN_TRY(motor.spin(30.0 * kDeg));
  for (int i = 0; i < 60; ++i) {
    TURNSCAN_TRY(motor.watch());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return motor.stop();
}

class Misbehaviour : public ::testing::TestWithParam<std::tuple<BoardKind, Outcome>> {};
INSTANTIATE_TEST_SUITE_P(Motor, Misbehaviour,
                         ::testing::Combine(kBoards, ::testing::ValuesIn(kOutcomes)),
                         [](const auto& test) {
                           return std::get<1>(test.param).name +
                                  std::string(name_of(std::get<0>(test.param)));
                         });

TEST_P(Misbehaviour, EndsInAStandingTableAndAClearMessage) {
  const auto& [kind, outcome] = GetParam();
  SimulatedTable table(kind, outcome.fault);
  auto motor = Motor::open(table.port(), quick(), RunContext());
  ASSERT_TRUE(motor) << motor.error().text();
  const auto done = spin_for_a_while(*motor);
  EXPECT_TRUE(table.was_told_to_turn());
  // A table without its cable cannot be told to stop: it does so by itself, within two seconds.
  EXPECT_TRUE(table.stands_within(outcome.fault == BoardFault::kDisappears ? 4.0 : 0.5));
  const char* words = kind == BoardKind::kText ? outcome.text : outcome.gcode;
  if (words == nullptr) {
    EXPECT_TRUE(done) << done.error().text();
    return;
  }
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr(words));
  EXPECT_THAT(done.error().message, HasSubstr("; "));
  EXPECT_THAT(done.error().message, ::testing::Not(HasSubstr("\n")));
  EXPECT_EQ(done.error().path, table.port());
}

TEST(Motor, ABoardThatNeverAnswersIsNotOpened) {
  SimulatedTable table(BoardKind::kText, BoardFault::kSilent, true);
  const auto motor = Motor::open(table.port(), quick(), RunContext());
  ASSERT_FALSE(motor);
  EXPECT_EQ(motor.error().code, ErrorCode::kDeviceLost);
  EXPECT_THAT(motor.error().message, HasSubstr("no turntable answers"));
}

/// What a board says of itself, or of a line, that does no harm.
TEST(Motor, MarlinAsksForADamagedLineAndIsGivenTimeWhenItIsBusy) {
  for (const BoardFault fault : {BoardFault::kDamagesOne, BoardFault::kBusy, BoardFault::kNoLimits,
                                 BoardFault::kTalkative}) {
    MotorOptions options = quick();
    options.protocol = MotorProtocol::kMarlin;  // nothing else is said to it first
    SimulatedTable table(BoardKind::kMarlin, fault);
    auto motor = Motor::open(table.port(), options, RunContext());
    ASSERT_TRUE(motor) << motor.error().text();
    const auto done = motor->rotate(30.0 * kDeg, 80.0 * kDeg, RunContext());
    ASSERT_TRUE(done) << done.error().text();
    EXPECT_NEAR(table.angle_deg(), 30.0, 0.01);
  }
}

TEST(Motor, MarlinThatCannotSayWhereItIsWhileItTurnsIsStopped) {
  SimulatedTable table(BoardKind::kMarlin, BoardFault::kBlind);
  auto motor = Motor::open(table.port(), quick(), RunContext());
  ASSERT_TRUE(motor) << motor.error().text();
  const auto done = motor->rotate(90.0 * kDeg, 20.0 * kDeg, RunContext());
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(done.error().message, HasSubstr("M114_REALTIME"));
  EXPECT_TRUE(table.stands_within(0.3));
  EXPECT_LT(table.angle_deg(), 80.0);
}

TEST(Motor, ABoardIsFoundWithoutItsGreetingAndAsItsProtocolIsStated) {
  for (const auto& [kind, protocol, name] :
       {std::tuple(BoardKind::kFluidNc, MotorProtocol::kFluidNc, "[FluidNC"),
        std::tuple(BoardKind::kGrblHal, MotorProtocol::kGrblHal, "GrblHAL"),
        std::tuple(BoardKind::kMarlin, MotorProtocol::kMarlin, "Marlin")}) {
    SimulatedTable table(kind, BoardFault::kNone);
    MotorOptions options = quick();
    options.protocol = protocol;
    const auto motor = Motor::open(table.port(), options, RunContext());
    ASSERT_TRUE(motor) << motor.error().text();
    EXPECT_THAT(motor->board(), HasSubstr(name));
  }
}

TEST(Motor, ABoardInTheNetworkIsNamedByHostAndPort) {
  for (const auto& [port, code] : {std::pair("tcp:", ErrorCode::kInvalidOption),
                                   {"tcp:127.0.0.1", ErrorCode::kInvalidOption},
                                   {"tcp:127.0.0.1:1", ErrorCode::kIo}}) {
    const auto motor = Motor::open(port, quick(), RunContext());
    ASSERT_FALSE(motor);
    EXPECT_EQ(motor.error().code, code) << motor.error().text();
    EXPECT_EQ(motor.error().path, port);
  }
}

TEST(Motor, APortThatDoesNotExistIsNotFound) {
  const auto motor = Motor::open("/dev/ttyNOT-THERE", quick(), RunContext());
  ASSERT_FALSE(motor);
  EXPECT_EQ(motor.error().code, ErrorCode::kNotFound);
}

TEST(Motor, AFileIsNoPort) {
  const auto motor = Motor::open("/etc/passwd", quick(), RunContext());
  ASSERT_FALSE(motor);
  EXPECT_THAT(motor.error().text(), HasSubstr("/etc/passwd"));
}

TEST(Motor, ChecksEveryOption) {
  MotorOptions options;
  const auto refuses = [&](const char* name, const char* value) {
    EXPECT_FALSE(describe(options).set(name, value)) << name << " " << value;
  };
  refuses("motor-protocol", "morse");
  refuses("motor-baud", "1");
  refuses("motor-timeout", "0s");
  refuses("motor-boot", "-1s");
  refuses("motor-units", "0");
  refuses("motor-max-speed", "0deg/s");
  options.timeout_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Motor::open("/dev/null", options, RunContext()).error().code,
            ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
