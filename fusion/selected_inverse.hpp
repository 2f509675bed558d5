#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <stop_token>

#include "survey/result.hpp"

namespace terrawalk {

/// Entries of the inverse of a sparse symmetric positive definite matrix: all of its diagonal, all where the
/// matrix itself has entries, and those where its Cholesky factor fills in. For a normal matrix these are the
/// variances and the covariances of unknowns that share an equation. Constant once made, cheap to copy; safe
/// from any thread.
class SelectedInverse {
  public:
    /// Entry (i, j), the same as (j, i); NaN where it was not computed.
    [[nodiscard]] double at(Eigen::Index i, Eigen::Index j) const;
    [[nodiscard]] Eigen::VectorXd diagonal() const;

  private:
    friend class SparseCholesky;
    struct Blocks;
    explicit SelectedInverse(std::shared_ptr<const Blocks> blocks);
    std::shared_ptr<const Blocks> blocks_;
};

/// Cholesky factor of a sparse symmetric positive definite matrix, P A P' = L L', in the order of a nested
/// dissection (METIS), which for a walk with crossings fills in a half to a fifth of what minimum degree
/// does; numbers are found supernode by supernode in dense matrices. One thread; the same bytes each time on
/// one machine. Queries are safe from any thread.
class SparseCholesky {
  public:
    /// @param A  square; only its lower triangle is read, diagonal included
    /// Errors: BadData when A has an entry that is not finite, or when it is not positive definite to
    /// rounding: a pivot that is not above 64 eps of its diagonal entry, as for unknowns that nothing
    /// measures; Cancelled.
    [[nodiscard]] static Result<SparseCholesky> factorize(const Eigen::SparseMatrix<double>& A,
                                                          const std::stop_token& stop = {});

    /// The factor of another matrix of the same size and much the same pattern, such as that of the next
    /// iteration: keeps the order, and the symbolic analysis as well where the pattern is the very same.
    /// After an error this object holds no factor and may only be factorized anew.
    [[nodiscard]] Result<void> refactorize(const Eigen::SparseMatrix<double>& A,
                                           const std::stop_token& stop = {});

    /// x with A x = b.
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
    [[nodiscard]] double logDeterminant() const;  ///< natural logarithm of det A
    [[nodiscard]] Eigen::Index factorNonZeros() const;

    /// The inverse on the pattern of the factor, in about the time of a factorization. With the columns J of
    /// a supernode and the rows R below it:
    ///     Z_RJ = -Z_RR Y,   Z_JJ = (L_JJ L_JJ')^-1 - Y' Z_RJ,   Y = L_RJ L_JJ^-1
    /// from the last supernode to the first.
    /// Source: Takahashi, Fagan and Chin 1973; Erisman and Tinney 1975; by blocks: Lin et al. 2011 (SelInv).
    /// Errors: Cancelled.
    [[nodiscard]] Result<SelectedInverse> selectedInverse(const std::stop_token& stop = {}) const;

    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;
    ~SparseCholesky();

  private:
    struct Factor;
    explicit SparseCholesky(std::unique_ptr<Factor> factor);
    std::unique_ptr<Factor> factor_;
};

}  // namespace terrawalk
