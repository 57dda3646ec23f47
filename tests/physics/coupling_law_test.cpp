// The coupling along one axis, free and loaded, without a simulator.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "physics/coupling/CouplingLaw.h"
#include "physics/scene/Oracles.h"

namespace heft {
namespace {

constexpr CouplingAxis paper{0.010, 50, 1};

// Clone and target along one axis.
struct Axis {
  CouplingLaw law;
  double clone = 0, target = 0;

  double offset() const { return clone - target; }
  // A steady force on the clone enters as in a contact solver: through the solver mass.
  void step(double h_s, double target_velocity = 0, double force = 0) {
    const FreeStep free = law.begin(offset(), target_velocity, h_s);
    const double velocity = free.velocity + force * h_s / free.solver_mass;
    law.end(velocity);
    clone += h_s * velocity;
    target += h_s * target_velocity;
  }
};

RC_GTEST_PROP(CouplingLaw, ExactSchemeFollowsTheFreeReturnForAnyDampingAndStep, ()) {
  const double z = *rc::gen::inRange(30, 300) / 100.0;
  const double h_s = *rc::gen::inRange(1, 70) / 1000.0;
  const CouplingAxis axis{paper.mass, paper.stiffness, z};
  const FreeReturn left(axis.stiffness, axis.mass, z);
  Axis x{CouplingLaw(CouplingScheme::exact, axis), 0.03};
  for (int i = 1; i <= 50; ++i) {
    x.step(h_s);
    RC_ASSERT(std::abs(x.offset() - 0.03 * left(i * h_s)) < 1e-12);
  }
}

RC_GTEST_PROP(CouplingLaw, ExactSchemeStaysExactWhenTheStepChanges, ()) {
  const auto steps_us = *rc::gen::container<std::vector<int>>(40, rc::gen::inRange(500, 8000));
  const FreeReturn left(paper.stiffness, paper.mass, 1);
  Axis x{CouplingLaw(CouplingScheme::exact, paper), 0.03};
  double t_s = 0;
  for (int step_us : steps_us) {
    x.step(step_us * 1e-6);
    t_s += step_us * 1e-6;
    RC_ASSERT(std::abs(x.offset() - 0.03 * left(t_s)) < 1e-10);
  }
}

// With a soft spring and short steps the motion of one step is a billionth, which must be accurate.
TEST(CouplingLaw, TheFirstOfManySmallStepsIsAsLongAsItIs) {
  for (const double z : {0.999, 1.0, 1.01, 2.01, 5.0}) {
    const CouplingAxis axis{1, 0.001, z};
    CouplingLaw law(CouplingScheme::exact, axis);
    const double h_s = 1e-3, turn = h_s * std::sqrt(axis.stiffness / axis.mass);
    const double first_m = 0.03 * turn * turn / 2 * (1 - 2 * z * turn / 3);
    EXPECT_NEAR(law.begin(0.03, 0, h_s).velocity * h_s / -first_m, 1, 1e-6) << z;
    EXPECT_NEAR(oscillator_step(axis, h_s).offset_by_offset, 1 - first_m / 0.03, 1e-14) << z;
  }
}

TEST(CouplingLaw, ALoadedRestIsNotDisturbedByAChangeOfStep) {
  Axis x{CouplingLaw(CouplingScheme::exact, paper)};
  for (int i = 0; i < 500; ++i) x.step(1.0 / 240, 0, -1.5);
  for (double h_s : {1.0 / 255, 1.0 / 120, 1.0 / 1000}) {
    x.step(h_s, 0, -1.5);
    EXPECT_NEAR(x.offset(), -0.03, 1e-12) << h_s;
  }
}

TEST(CouplingLaw, BothSchemesGiveTheStaticLagUnderALoad) {
  for (auto scheme : {CouplingScheme::implicit_euler, CouplingScheme::exact}) {
    Axis x{CouplingLaw(scheme, paper)};
    for (int i = 0; i < 500; ++i) x.step(1.0 / 240, 0.1, -1.5);
    EXPECT_NEAR(x.offset(), -1.5 / 50, 1e-12);
  }
}

TEST(CouplingLaw, ImplicitEulerIsTheTextbookStep) {
  // v1 = v0 + h/m (-k (x0 + h v1) - c v1), solved by hand for x0 = 0.03, v0 = 0.2.
  const double h = 1.0 / 60, m = paper.mass, k = paper.stiffness, c = 2 * std::sqrt(k * m);
  CouplingLaw law(CouplingScheme::implicit_euler, paper);
  law.restart(0.2, 0);
  const FreeStep step = law.begin(0.03, 0, h);
  EXPECT_NEAR(step.velocity, (m * 0.2 - h * k * 0.03) / (m + h * c + h * h * k), 1e-15);
  EXPECT_NEAR(step.velocity, 0.2 + h / m * (-k * (0.03 + h * step.velocity) - c * step.velocity),
              1e-13);
}

// Over an instant the clone responds with its bare mass, independent of the damping.
TEST(CouplingLaw, HasTheBareMassWithinAnInstant) {
  for (const double damping_ratio : {0.5, 1.0, 2.0}) {
    CouplingLaw law(CouplingScheme::exact, {0.1, 100, damping_ratio});
    law.restart(0.2, 0);
    const FreeStep step = law.begin(0.01, 0, 1e-9);
    EXPECT_NEAR(step.solver_mass, 0.1, 1e-6);
    EXPECT_NEAR(step.velocity, 0.2, 1e-6);
  }
}

TEST(CouplingLaw, IsRefusedWhereHardlyDampedAndFasterThanItsSteps) {
  Coupling coupling;
  EXPECT_FALSE(instability(coupling, 1));
  coupling.stiffness_n_per_m = 1e5;  // 3162 rad/s with 10 g
  coupling.damping_ratio = 0.05;
  EXPECT_TRUE(instability(coupling, 60));
  EXPECT_FALSE(instability(coupling, 264));
  coupling.damping_ratio = 0.1;
  EXPECT_FALSE(instability(coupling, 60));
  coupling.damping_ratio = 0;
  EXPECT_TRUE(instability(coupling, 263));
  coupling.decoupled = false;
  EXPECT_FALSE(instability(coupling, 60));
}

RC_GTEST_PROP(CouplingLaw, IsStableForAnyStiffness, ()) {
  const CouplingAxis axis{std::pow(10, *rc::gen::inRange(-7, 1)),
                          std::pow(10, *rc::gen::inRange(-3, 10)),
                          *rc::gen::inRange(1, 500) / 100.0};
  const double h_s = 1 / *rc::gen::elementOf(std::vector<double>{15, 60, 240, 1000});
  for (auto scheme : {CouplingScheme::implicit_euler, CouplingScheme::exact}) {
    Axis x{CouplingLaw(scheme, axis), 0.03};
    for (int i = 0; i < 200; ++i) {
      x.step(h_s);
      RC_ASSERT(std::abs(x.offset()) <= 0.03 * (1 + 1e-9));
    }
  }
}

}  // namespace
}  // namespace heft
