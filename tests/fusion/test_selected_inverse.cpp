#include "fusion/selected_inverse.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stop_token>
#include <thread>
#include <vector>

#include "tests/support/adjustment_matrix.hpp"
#include "tests/support/random_numbers.hpp"

namespace terrawalk {
namespace {

using Eigen::Index;
using Matrix = Eigen::SparseMatrix<double>;

/// Diagonally dominant, so that the condition number is small and errors stay near rounding.
Matrix dominant(Index n, const std::vector<std::pair<Index, Index>>& pairs, test::RandomNumbers& random) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (const auto& [i, j] : pairs) {
        if (i != j) dense(i, j) = dense(j, i) = random.uniform(-1.0, 1.0);
    }
    dense.diagonal() = dense.cwiseAbs().rowwise().sum().array() + random.uniform(0.5, 2.0);
    return dense.sparseView();
}

Matrix scattered(Index n, std::size_t count, test::RandomNumbers& random) {
    std::vector<std::pair<Index, Index>> pairs;
    for (std::size_t k = 0; k < count; ++k) {
        pairs.emplace_back(random.below(static_cast<std::size_t>(n)),
                           random.below(static_cast<std::size_t>(n)));
    }
    return dominant(n, pairs, random);
}

Matrix banded(Index n, Index half_width, test::RandomNumbers& random) {
    std::vector<std::pair<Index, Index>> pairs;
    for (Index j = 0; j < n; ++j) {
        for (Index i = j; i <= std::min(n - 1, j + half_width); ++i) pairs.emplace_back(i, j);
    }
    return dominant(n, pairs, random);
}

/// A few unknowns that meet all others.
Matrix arrow(Index n, Index heads, test::RandomNumbers& random) {
    std::vector<std::pair<Index, Index>> pairs;
    for (Index head = 0; head < heads; ++head) {
        for (Index i = 0; i < n; ++i) pairs.emplace_back(i, n / 2 + head);
    }
    return dominant(n, pairs, random);
}

/// Diagonal dominance by 0.5 or more bounds the inverse by 2 (Varah 1975), and rounding by n eps times the
/// norms of the matrix and its inverse, squared.
double tolerance(const Matrix& A) {
    const double norm = Eigen::MatrixXd(A).cwiseAbs().rowwise().sum().maxCoeff();
    return 4.0 * static_cast<double>(A.rows()) * std::numeric_limits<double>::epsilon() * 2.0 * norm;
}

void expectInverse(const Matrix& A) {
    const auto cholesky = SparseCholesky::factorize(A);
    ASSERT_TRUE(cholesky) << cholesky.error().text();
    const SelectedInverse selected = cholesky->selectedInverse().value();
    const Eigen::MatrixXd inverse = Eigen::MatrixXd(A).inverse();
    Index known = 0;
    Index missing = 0;  // of the matrix's own entries
    double worst = 0.0;
    const Eigen::MatrixXd dense(A);
    for (Index j = 0; j < A.cols(); ++j) {
        for (Index i = 0; i < A.rows(); ++i) {
            const double entry = selected.at(i, j);
            if (std::isnan(entry)) {
                missing += dense(i, j) != 0.0 ? 1 : 0;
            } else {
                ++known;
                worst = std::max(worst, std::abs(entry - inverse(i, j)));
            }
        }
    }
    EXPECT_EQ(missing, 0);
    EXPECT_LE(worst, tolerance(A));
    EXPECT_EQ(known, 2 * cholesky->factorNonZeros() - A.rows());
    EXPECT_LE((selected.diagonal() - inverse.diagonal()).cwiseAbs().maxCoeff(), tolerance(A));
}

TEST(SelectedInverse, IsTheInverseOnScatteredPatterns) {
    test::RandomNumbers random(1);
    for (const std::size_t n : {1U, 2U, 5U, 30U, 120U}) {
        for (const std::size_t count : {std::size_t{0}, n / 2, 2 * n, n * n}) {
            SCOPED_TRACE(n);
            expectInverse(scattered(static_cast<Index>(n), count, random));
        }
    }
}

TEST(SelectedInverse, IsTheInverseOnBands) {
    test::RandomNumbers random(2);
    for (const Index half_width : {1, 4, 40}) expectInverse(banded(150, half_width, random));
}

TEST(SelectedInverse, IsTheInverseOnArrows) {
    test::RandomNumbers random(3);
    for (const Index heads : {1, 3}) expectInverse(arrow(80, heads, random));
}

TEST(SelectedInverse, IsTheInverseOfSeparateBlocks) {
    test::RandomNumbers random(4);
    Matrix one = banded(40, 3, random);
    Eigen::MatrixXd both = Eigen::MatrixXd::Zero(100, 100);
    both.topLeftCorner(40, 40) = one;
    both.bottomRightCorner(60, 60) = Eigen::MatrixXd(arrow(60, 2, random));
    expectInverse(both.sparseView());
}

TEST(SelectedInverse, IsTheInverseOfAWiderBlockThanASupernode) {
    test::RandomNumbers random(5);
    expectInverse(scattered(300, 300U * 300U, random));
}

TEST(SelectedInverse, KnowsNothingOutsideThePattern) {
    test::RandomNumbers random(6);
    // No two of the tips meet, and the head is eliminated last.
    const Matrix A = arrow(50, 1, random);
    const auto cholesky = SparseCholesky::factorize(A);
    ASSERT_TRUE(cholesky);
    EXPECT_EQ(cholesky->factorNonZeros(), 99);
    EXPECT_TRUE(std::isnan(cholesky->selectedInverse().value().at(0, 49)));
}

TEST(SelectedInverse, AgreesWithUnitVectorSolvesOfAnAdjustment) {
    const Matrix A = test::AdjustmentMatrix(300, 3, 1.0, 7).matrix();
    const auto cholesky = SparseCholesky::factorize(A);
    ASSERT_TRUE(cholesky);
    const SelectedInverse selected = cholesky->selectedInverse().value();
    for (Index j = 0; j < A.cols(); j += 97) {
        const Eigen::VectorXd column = cholesky->solve(Eigen::VectorXd::Unit(A.cols(), j));
        for (Matrix::InnerIterator entry(A, j); entry; ++entry) {
            // The damping of 0.05 in the matrix bounds the inverse by 20.
            EXPECT_NEAR(selected.at(entry.row(), j), column[entry.row()], 20.0 * 1e-12);
        }
    }
}

TEST(SparseCholesky, SolvesAndKnowsTheDeterminant) {
    test::RandomNumbers random(8);
    const Matrix A = scattered(60, 200, random);
    const auto cholesky = SparseCholesky::factorize(A);
    ASSERT_TRUE(cholesky);
    Eigen::VectorXd x(60);
    for (double& value : x) value = random.normal();
    EXPECT_LE((cholesky->solve(A * x) - x).cwiseAbs().maxCoeff(), tolerance(A));
    const Eigen::LLT<Eigen::MatrixXd> dense{Eigen::MatrixXd(A)};
    const double expected = 2.0 * Eigen::MatrixXd(dense.matrixL()).diagonal().array().log().sum();
    EXPECT_NEAR(cholesky->logDeterminant(), expected, 60.0 * tolerance(A));
}

TEST(SparseCholesky, ReadsTheLowerTriangleOnly) {
    test::RandomNumbers random(9);
    const Matrix A = scattered(40, 100, random);
    const Matrix lower = A.triangularView<Eigen::Lower>();
    const auto whole = SparseCholesky::factorize(A);
    const auto half = SparseCholesky::factorize(lower);
    ASSERT_TRUE(whole && half);
    EXPECT_EQ(whole->selectedInverse().value().diagonal(), half->selectedInverse().value().diagonal());
}

TEST(SparseCholesky, RefactorizesNewNumbersAndNewPatterns) {
    test::RandomNumbers random(10);
    const Matrix first = scattered(80, 200, random);
    auto cholesky = SparseCholesky::factorize(first);
    ASSERT_TRUE(cholesky);
    const Matrix numbers = 3.0 * first;
    ASSERT_TRUE(cholesky->refactorize(numbers));
    EXPECT_LE(
        (3.0 * cholesky->selectedInverse().value().diagonal() - Eigen::MatrixXd(first).inverse().diagonal())
            .cwiseAbs()
            .maxCoeff(),
        tolerance(first));
    const Matrix pattern = first + scattered(80, 150, random);
    ASSERT_TRUE(cholesky->refactorize(pattern));
    EXPECT_LE((cholesky->selectedInverse().value().diagonal() - Eigen::MatrixXd(pattern).inverse().diagonal())
                  .cwiseAbs()
                  .maxCoeff(),
              tolerance(pattern));
}

TEST(SparseCholesky, SameBytesOnAnyThread) {
    const Matrix A = test::AdjustmentMatrix(400, 2, 1.0, 11).matrix();
    std::vector<Eigen::VectorXd> diagonals(4);
    std::vector<std::thread> threads;
    for (Eigen::VectorXd& diagonal : diagonals) {
        threads.emplace_back([&] {
            const auto cholesky = SparseCholesky::factorize(A);
            if (cholesky) diagonal = cholesky->selectedInverse().value().diagonal();
        });
    }
    for (std::thread& thread : threads) thread.join();
    ASSERT_EQ(diagonals[0].size(), A.cols());
    for (const Eigen::VectorXd& diagonal : diagonals) EXPECT_EQ(diagonal, diagonals[0]);
}

TEST(SparseCholesky, RefusesWhatDoesNotDetermineItsUnknowns) {
    // Differences alone leave the level open: exactly singular.
    Eigen::MatrixXd levels = Eigen::MatrixXd::Zero(30, 30);
    for (Index i = 0; i + 1 < 30; ++i) {
        levels(i, i) += 1.0;
        levels(i + 1, i + 1) += 1.0;
        levels(i, i + 1) = levels(i + 1, i) = -1.0;
    }
    EXPECT_FALSE(SparseCholesky::factorize(levels.sparseView()));

    Eigen::MatrixXd unmeasured = Eigen::MatrixXd::Identity(10, 10);
    unmeasured(4, 4) = 0.0;
    const auto missing = SparseCholesky::factorize(unmeasured.sparseView());
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, testing::EndsWith("unknown 4"));

    Eigen::MatrixXd indefinite = Eigen::MatrixXd::Identity(10, 10);
    indefinite(2, 7) = indefinite(7, 2) = 2.0;
    EXPECT_FALSE(SparseCholesky::factorize(indefinite.sparseView()));

    Eigen::MatrixXd not_finite = Eigen::MatrixXd::Identity(10, 10);
    not_finite(3, 3) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(SparseCholesky::factorize(not_finite.sparseView()));
    not_finite(3, 3) = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(SparseCholesky::factorize(not_finite.sparseView()));
}

TEST(SparseCholesky, StopsWhenAskedTo) {
    const Matrix A = test::AdjustmentMatrix(100, 1, 1.0, 12).matrix();
    std::stop_source source;
    auto cholesky = SparseCholesky::factorize(A, source.get_token());
    ASSERT_TRUE(cholesky);
    ASSERT_TRUE(cholesky->selectedInverse(source.get_token()));
    source.request_stop();
    const auto inverse = cholesky->selectedInverse(source.get_token());
    ASSERT_FALSE(inverse);
    EXPECT_EQ(inverse.error().kind, ErrorKind::Cancelled);
    const auto factorized = SparseCholesky::factorize(A, source.get_token());
    ASSERT_FALSE(factorized);
    EXPECT_EQ(factorized.error().kind, ErrorKind::Cancelled);
    const auto again = cholesky->refactorize(A, source.get_token());
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().kind, ErrorKind::Cancelled);
}

TEST(SparseCholesky, AcceptsWeaklyDeterminedUnknowns) {
    // A level known to 1e5 times worse than the differences: pivots lose ten digits, not all.
    Eigen::MatrixXd levels = 1e-10 * Eigen::MatrixXd::Identity(30, 30);
    for (Index i = 0; i + 1 < 30; ++i) {
        levels(i, i) += 1.0;
        levels(i + 1, i + 1) += 1.0;
        levels(i, i + 1) = levels(i + 1, i) = -1.0;
    }
    const auto cholesky = SparseCholesky::factorize(levels.sparseView());
    ASSERT_TRUE(cholesky) << cholesky.error().text();
    // The level's variance is 1e10 / 30; the condition number 4e10 leaves five digits.
    EXPECT_NEAR(cholesky->selectedInverse().value().at(0, 0) * 30e-10, 1.0, 1e-4);
}

}  // namespace
}  // namespace terrawalk
