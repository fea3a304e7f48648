// What CRBA, RNEA, ABA and the derivatives of ABA of Pinocchio take for an arm, whose numbers are in
// a file that `casadi_arm.py` has written.
//
// All of it is compiled here, for this processor. Nothing is linked: the library of the wheel knows
// no AVX, and lays its matrices out otherwise.
//
// Prints a line `quantity nanoseconds` for each round over random states. All are functions of the
// angles: sines and cosines are inside.

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/model.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include <cstdio>
#include <fstream>
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

template <int ROWS, int COLUMNS> Eigen::Matrix<double, ROWS, COLUMNS> read(std::istream &file) {
  Eigen::Matrix<double, ROWS, COLUMNS> matrix;
  for (int row = 0; row < ROWS; ++row)
    for (int column = 0; column < COLUMNS; ++column)
      file >> matrix(row, column);
  return matrix;
}

// Of each joint its place in the link before and its axis; of its link the inertia.
pinocchio::Model arm(std::istream &file) {
  pinocchio::Model model;
  pinocchio::JointIndex joint = 0;
  for (int count = 0;; ++count) {
    const auto rotation = read<3, 3>(file);
    const Eigen::Vector3d translation = read<3, 1>(file), axis = read<3, 1>(file);
    double mass = 0.0;
    file >> mass;
    const Eigen::Vector3d lever = read<3, 1>(file);
    const auto inertia = read<3, 3>(file);
    if (!file)
      return model;
    const pinocchio::SE3 place(rotation, translation);
    const std::string name = "joint " + std::to_string(count);
    if (axis == Eigen::Vector3d::UnitX())
      joint = model.addJoint(joint, pinocchio::JointModelRX(), place, name);
    else if (axis == Eigen::Vector3d::UnitY())
      joint = model.addJoint(joint, pinocchio::JointModelRY(), place, name);
    else if (axis == Eigen::Vector3d::UnitZ())
      joint = model.addJoint(joint, pinocchio::JointModelRZ(), place, name);
    else
      joint = model.addJoint(joint, pinocchio::JointModelRevoluteUnaligned(axis), place, name);
    model.appendBodyToJoint(joint, pinocchio::Inertia(mass, lever, inertia),
                            pinocchio::SE3::Identity());
  }
}

} // namespace

int main(int count, char **arguments) {
  std::ifstream file(count == 2 ? arguments[1] : "");
  const auto model = arm(file);
  if (model.nv == 0) {
    std::fprintf(stderr, "usage: pinocchio FILE\n");
    return 2;
  }
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
