// What RNEA, CRBA and ABA of Pinocchio take for an arm of a URDF file.
//
// Prints lines `quantity nanoseconds`: the median of rounds over random states.

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/model.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/parsers/urdf.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace {

constexpr int STATES = 64;
constexpr int REPEATS = 40;
constexpr int ROUNDS = 21;

template <class Work> double median(Work work) {
  std::vector<double> times;
  for (int round = 0; round <= ROUNDS; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int repeat = 0; repeat < REPEATS; ++repeat)
      for (int state = 0; state < STATES; ++state)
        work(state);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    // The first round warms up.
    if (round > 0)
      times.push_back(time.count() / (REPEATS * STATES));
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
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
  const double inverse = median(
      [&](int k) { pinocchio::rnea(model, data, positions[k], rates[k], others[k]); });
  const double mass = median([&](int k) { pinocchio::crba(model, data, positions[k]); });
  const double forward = median(
      [&](int k) { pinocchio::aba(model, data, positions[k], rates[k], others[k]); });
  std::printf("mass %.2f\ninverse %.2f\nforward %.2f\n", mass, inverse, forward);
}
