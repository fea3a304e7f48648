// What CRBA, RNEA, ABA and the derivatives of ABA of Pinocchio take for an arm of a URDF file.
//
// Prints a line `quantity nanoseconds` for each round over random states. All are functions of the
// angles: sines and cosines are inside.

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/model.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/parsers/urdf.hpp>

#include <cstdio>
#include <vector>

#include "clock.h"

namespace {

constexpr int REPEATS = 40;

template <class Work> void measure(const char *name, Work work) {
  // The first round warms up.
  for (int round = 0; round <= ROUNDS; ++round) {
    const double start = processor_time();
    for (int repeat = 0; repeat < REPEATS; ++repeat)
      for (int state = 0; state < STATES; ++state)
        work(state);
    if (round > 0)
      std::printf("%s %.2f\n", name, (processor_time() - start) / (REPEATS * STATES));
  }
}

} // namespace

int main(int count, char **arguments) {
  if (count != 3) {
    std::fprintf(stderr, "usage: pinocchio FILE.urdf AXES\n");
    return 2;
  }
  pinocchio::Model whole;
  pinocchio::urdf::buildModel(arguments[1], whole);
  // What moves behind the last axis of the arm, such as fingers, is held.
  std::vector<pinocchio::JointIndex> held;
  for (int joint = std::atoi(arguments[2]) + 1; joint < whole.njoints; ++joint)
    held.push_back(joint);
  const auto model = pinocchio::buildReducedModel(whole, held, pinocchio::neutral(whole));
  pinocchio::Data data(model);
  std::srand(1);
  std::vector<Eigen::VectorXd> positions, rates, others;
  for (int state = 0; state < STATES; ++state) {
    positions.push_back(Eigen::VectorXd::Random(model.nq));
    rates.push_back(Eigen::VectorXd::Random(model.nv));
    others.push_back(Eigen::VectorXd::Random(model.nv));
  }
  measure("mass-angles", [&](int k) { pinocchio::crba(model, data, positions[k]); });
  measure("inverse-angles",
          [&](int k) { pinocchio::rnea(model, data, positions[k], rates[k], others[k]); });
  measure("forward-angles",
          [&](int k) { pinocchio::aba(model, data, positions[k], rates[k], others[k]); });
  measure("linearise-angles", [&](int k) {
    pinocchio::computeABADerivatives(model, data, positions[k], rates[k], others[k]);
  });
}
