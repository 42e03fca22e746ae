// Prints the time of one pinocchio::rnea of a URDF (ns) and a checksum, and the same of its
// derivatives: the same work on the same states as rnea_time.rs.
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/parsers/urdf.hpp>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  pinocchio::Model model;
  pinocchio::urdf::buildModel(argv[1], model);
  pinocchio::Data data(model);
  const int n = model.nv, states = 1000, rounds = 300;

  uint64_t seed = 1;
  auto draw = [&] {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return 4.0 * ((seed >> 11) / double(1ULL << 53)) - 2.0;
  };
  std::vector<Eigen::VectorXd> q(states), v(states), a(states);
  for (int s = 0; s < states; ++s)
    for (auto* vector : {&q[s], &v[s], &a[s]}) {
      vector->resize(n);
      for (int i = 0; i < n; ++i) (*vector)[i] = draw();
    }

  auto time = [&](const char* what, auto evaluate) {
    double fastest = std::numeric_limits<double>::infinity(), checksum = 0;
    for (int round = 0; round < rounds; ++round) {
      checksum = 0;
      const auto start = std::chrono::steady_clock::now();
      for (int s = 0; s < states; ++s) checksum += evaluate(q[s], v[s], a[s]);
      const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
      fastest = std::min(fastest, taken.count() / states);
    }
    std::printf("%s %.1f %.6f\n", what, fastest, checksum);
  };
  time("rnea", [&](const auto& q, const auto& v, const auto& a) {
    pinocchio::rnea(model, data, q, v, a);
    return data.tau[0] + data.tau[n - 1];
  });
  time("derivatives", [&](const auto& q, const auto& v, const auto& a) {
    pinocchio::computeRNEADerivatives(model, data, q, v, a);
    return data.dtau_dq(0, n - 1) + data.dtau_dv(0, n - 1) + data.M(0, n - 1);
  });
}
