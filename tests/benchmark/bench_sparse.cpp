// The normal matrix of a made-up joint adjustment (30 minutes of walk and 16 short ones): Cholesky factor and
// selected inverse in nested dissection order, against Eigen's own factorization in minimum degree order.
// Minimum of several repeats, one thread.

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <chrono>
#include <limits>

#include "fusion/selected_inverse.hpp"
#include "tests/support/adjustment_matrix.hpp"

namespace {

using namespace terrawalk;
constexpr int kRepeats = 7;

template <class Work>
double leastMilliseconds(Work work) {
    using Clock = std::chrono::steady_clock;
    double least = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        const auto began = Clock::now();
        work();
        least = std::min(least, std::chrono::duration<double, std::milli>(Clock::now() - began).count());
    }
    return least;
}

void measure(double reach_m) {
    const auto A = test::AdjustmentMatrix(1828, 16, reach_m, 1).matrix();
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> eigen;
    const double eigen_analyze_ms = leastMilliseconds([&] { eigen.analyzePattern(A); });
    const double eigen_factor_ms = leastMilliseconds([&] { eigen.factorize(A); });
    auto cholesky = SparseCholesky::factorize(A);
    if (!cholesky) {
        fmt::print("{}\n", cholesky.error().text());
        return;
    }
    const double first_ms = leastMilliseconds([&] { (void)SparseCholesky::factorize(A); });
    const double again_ms = leastMilliseconds([&] { (void)cholesky->refactorize(A); });
    const double inverse_ms = leastMilliseconds([&] { (void)cholesky->selectedInverse(); });
    fmt::print(
        "passes within {} m coupled, {} unknowns, {} entries\n"
        "  Eigen SimplicialLDLT, AMD   analysis {:6.1f} ms  factor {:7.1f} ms  {} nonzeros\n"
        "  SparseCholesky              first    {:6.1f} ms  again  {:7.1f} ms  {} nonzeros\n"
        "  selected inverse            {:6.1f} ms, {:.2f} of a factorization\n",
        reach_m, A.rows(), A.nonZeros(), eigen_analyze_ms, eigen_factor_ms,
        eigen.matrixL().nestedExpression().nonZeros(), first_ms, again_ms, cholesky->factorNonZeros(),
        inverse_ms, inverse_ms / again_ms);
}

}  // namespace

int main() {
    for (const double reach_m : {1.0, 2.0, 3.05}) measure(reach_m);
}
