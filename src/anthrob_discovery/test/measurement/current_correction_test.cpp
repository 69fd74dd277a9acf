// Currents that come late or through a filter beside voltage and velocity of their motors.
#include "measurement/current_correction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "anthrob_core/random.h"
#include "anthrob_sim/actuator/dc_motor.h"
#include "config.h"

namespace anthrob {
namespace discovery {
namespace current_correction_test {

double current(double t) {
  return 0.5 + 0.3 * std::sin(5.0 * t) + 0.2 * std::sin(23.0 * t);
}
double current_behind_filter(double t, double tau) {
  const auto part = [&](double amplitude, double rate) {
    return amplitude / std::hypot(1.0, rate * tau) * std::sin(rate * t - std::atan(rate * tau));
  };
  return 0.5 + part(0.3, 5.0) + part(0.2, 23.0);
}

/// The rig's flexor, whose resistance is 20 % larger than its model's.
/// @param beside rows between two measured positions
Description described(const std::function<double(double)>& measured, int beside = 1) {
  static const auto robot = load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml");
  const auto& motor = dynamic_cast<const DcMotor&>(*robot->muscles[0].actuator).parameters();
  const CounterRandom random(3, 1);
  Dataset data;
  data.folder = "run";
  Table& muscles = data.table("muscles");
  for (const char* name : {"position", "current", "voltage"}) {
    muscles.column(std::string("flexor/") + name);
  }
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.005 * i, x = 3.0 * std::sin(1.3 * t), v = 3.9 * std::cos(1.3 * t);
    const double values[] = {
        x, measured(t) + 0.004 * random.normal(static_cast<std::uint64_t>(i)),
        1.2 * motor.resistance * current(t) + motor.back_emf_constant * motor.ratio * v};
    muscles.t.push_back(static_cast<Nanoseconds>(i) * 5000000);
    for (std::size_t k = 0; k < 3; ++k) {
      const bool present = k > 0 || i % beside == 0;
      muscles.columns[k].values.push_back(present ? values[k] : NAN);
      muscles.columns[k].present.push_back(present ? 1 : 0);
    }
  }
  Description description;
  description.question.train = {data};
  correct_currents(*robot, description);
  return description;
}

/// Root mean square of what differs from the true current, apart from its ends [A].
double error_of(const Description& description) {
  const Series is = description.question.train[0].series("flexor/current");
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 20; i + 20 < is.t.size(); ++i) {
    squares += std::pow(is.values[i] - current(is.t[i]), 2), count += 1.0;
  }
  return std::sqrt(squares / count);
}

TEST(CurrentCorrection, LeavesRightCurrentsAlone) {
  const Description description = described(current);
  EXPECT_FALSE(description.corrected);
  EXPECT_TRUE(description.measurement.empty());
}

TEST(CurrentCorrection, NeedsVelocities) {
  const auto late = [](double t) { return current(t - 0.012); };
  EXPECT_FALSE(described(late).measurement.empty());
  EXPECT_TRUE(described(late, 11).measurement.empty());
}

TEST(CurrentCorrection, MovesWhatIsLate) {
  for (const double late : {0.0035, 0.012, -0.004}) {
    const Description description = described([&](double t) { return current(t - late); });
    ASSERT_EQ(description.measurement.size(), 1u) << late;
    EXPECT_EQ(description.measurement[0].what, "delay");
    EXPECT_NEAR(description.measurement[0].value, late, 5e-4);
    EXPECT_LE(description.measurement[0].ci95[0], late);
    EXPECT_GE(description.measurement[0].ci95[1], late);
    EXPECT_LT(error_of(description), 0.006);
  }
}

TEST(CurrentCorrection, UndoesAFilter) {
  const Description description =
      described([](double t) { return current_behind_filter(t, 0.01); });
  ASSERT_EQ(description.measurement.size(), 1u);
  EXPECT_EQ(description.measurement[0].what, "filter");
  EXPECT_NEAR(description.measurement[0].value, 0.01, 1e-3);
  EXPECT_LT(error_of(description), 0.012);  // its noise is larger now
}

}  // namespace current_correction_test
}  // namespace discovery
}  // namespace anthrob
