// Is a Cholesky worth its while where the matrix is symmetric? K + cj C + cj^2 M of the structure alone,
// without contacts, by KLU as the engine uses it, by Eigen's simplicial L D L^T and by CHOLMOD: refactor, and
// solve.
//
//   build/release/signorini_cholesky [greatest number of unknowns]
#include <fmt/core.h>

#include <Eigen/SparseCholesky>
#include <cstdlib>
#include <functional>

#ifdef SIGNORINI_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include "clock.hpp"
#include "linear/klu.hpp"
#include "scenes.hpp"
#include "signorini/simulate.hpp"

namespace {

using namespace signorini;
using benchmarks::cpu;

/// us a call, least of 5 batches of at least 20 ms.
double time(const std::function<void()>& f) {
  f();
  double best = 1e99;
  for (int batch = 0; batch < 5; ++batch) {
    const double start = cpu();
    int count = 0;
    while (cpu() - start < 0.02) {
      for (int i = 0; i < 8; ++i) f();
      count += 8;
    }
    best = std::min(best, 1e6 * (cpu() - start) / count);
  }
  return best;
}

template <class Solver>
void row(const char* name, const SparseMatrix& a) {
  Solver solver;
  solver.analyzePattern(a);
  Vector x = Vector::Ones(a.rows()), y(a.rows());
  const double factor = time([&] { solver.factorize(a); });
  const double solve = time([&] { y = solver.solve(x); });
  fmt::print("  {:<22} {:>12.2f} {:>12.2f}\n", name, factor, solve);
}

void table(const std::string& name, const Model& model) {
  const double cj = 1e6;
  SparseMatrix a = model.stiffness + cj * model.damping + cj * cj * model.mass;
  a.makeCompressed();
  fmt::print("{}, n = {}: us to refactor, us to solve\n", name, model.size());
  const std::vector<std::int64_t> start(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1),
      row_index(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  const std::vector<double> values(a.valuePtr(), a.valuePtr() + a.nonZeros());
  linear::Klu klu(start, row_index);
  klu.factor(values);
  std::vector<double> x(static_cast<std::size_t>(a.rows()), 1.0), y;
  const double factor = time([&] { klu.refactor(values); });
  const double solve = time([&] {
    y = x;
    klu.solve(y.data());
  });
  fmt::print("  {:<22} {:>12.2f} {:>12.2f}\n", "KLU, packed factors", factor, solve);
  row<Eigen::SimplicialLDLT<SparseMatrix>>("Eigen SimplicialLDLT", a);
  row<Eigen::SimplicialLLT<SparseMatrix>>("Eigen SimplicialLLT", a);
#ifdef SIGNORINI_CHOLMOD
  row<Eigen::CholmodSimplicialLDLT<SparseMatrix>>("CHOLMOD simplicial", a);
  row<Eigen::CholmodSupernodalLLT<SparseMatrix>>("CHOLMOD supernodal", a);
#endif
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int greatest = argc > 1 ? std::atoi(argv[1]) : 100000;
  table("pipeline", build_model(read_scene(SIGNORINI_MODELS "/pipeline.toml")));
  for (const int n : {1000, 10000, 100000})
    if (n <= greatest)
      table("bedded pipe", build_model(parse_scene(benchmarks::bedded_pipe(n, 2, 1e-3), "pipe")));
}
