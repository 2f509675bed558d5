#include "fusion/selected_inverse.hpp"

#include <fmt/format.h>
#include <metis.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

namespace terrawalk {

namespace {

using Eigen::Index;
using Matrix = Eigen::SparseMatrix<double>;
using Indices = std::vector<int>;

static_assert(sizeof(idx_t) == sizeof(int));

/// Whom each unknown meets in an equation, itself left out: rows and columns of a symmetric pattern.
struct Graph {
    Indices begins;
    Indices neighbours;
};

Graph graphOf(const Matrix& A) {
    const auto n = static_cast<std::size_t>(A.cols());
    Graph graph{Indices(n + 1, 0), {}};
    const auto visitPairs = [&](auto visit) {
        for (int j = 0; j < A.cols(); ++j) {
            for (Matrix::InnerIterator entry(A, j); entry; ++entry) {
                if (entry.row() > j)
                    visit(static_cast<std::size_t>(entry.row()), static_cast<std::size_t>(j));
            }
        }
    };
    visitPairs([&](std::size_t i, std::size_t j) {
        ++graph.begins[i + 1];
        ++graph.begins[j + 1];
    });
    for (std::size_t i = 0; i < n; ++i) graph.begins[i + 1] += graph.begins[i];
    graph.neighbours.resize(static_cast<std::size_t>(graph.begins[n]));
    Indices next(graph.begins.begin(), graph.begins.end() - 1);
    visitPairs([&](std::size_t i, std::size_t j) {
        graph.neighbours[static_cast<std::size_t>(next[i]++)] = static_cast<int>(j);
        graph.neighbours[static_cast<std::size_t>(next[j]++)] = static_cast<int>(i);
    });
    return graph;
}

/// Nested dissection: place of each unknown in the order of elimination.
Indices dissect(const Matrix& A) {
    auto n = static_cast<idx_t>(A.cols());
    Indices order(static_cast<std::size_t>(n));
    Indices place(static_cast<std::size_t>(n));
    Graph graph = graphOf(A);
    // METIS draws from the C library's one random sequence, which it seeds at the start.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    if (graph.neighbours.empty()) graph.neighbours.push_back(0);  // no address of nothing
    const int status = METIS_NodeND(&n, graph.begins.data(), graph.neighbours.data(), nullptr, nullptr,
                                    order.data(), place.data());
    if (status != METIS_OK) {  // out of memory; any order is a right one
        for (std::size_t i = 0; i < place.size(); ++i) place[i] = static_cast<int>(i);
    }
    return place;
}

Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutationOf(const Indices& place) {
    return Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>(
        Eigen::Map<const Eigen::VectorXi>(place.data(), static_cast<Index>(place.size())));
}

/// Upper triangle of P A P' from the lower one of A, rows rising in each column.
Matrix permutedUpper(const Matrix& A, const Indices& place) {
    Matrix lower(A.rows(), A.cols());
    lower.selfadjointView<Eigen::Lower>() = A.selfadjointView<Eigen::Lower>().twistedBy(permutationOf(place));
    return lower.transpose();  // which sorts
}

/// Parent of each column in the elimination tree, -1 at a root. Source: Liu 1986.
Indices eliminationTree(const Matrix& upper) {
    const auto n = static_cast<std::size_t>(upper.cols());
    Indices parent(n, -1);
    Indices ancestor(n, -1);
    for (int j = 0; j < upper.cols(); ++j) {
        for (Matrix::InnerIterator entry(upper, j); entry && entry.row() < j; ++entry) {
            auto i = static_cast<int>(entry.row());
            while (i != -1 && i < j) {
                const int above = std::exchange(ancestor[static_cast<std::size_t>(i)], j);
                if (above == -1) parent[static_cast<std::size_t>(i)] = j;
                i = above;
            }
        }
    }
    return parent;
}

/// Place of each column when every subtree is numbered without a gap, a parent right after its last child, so
/// that columns of equal pattern stand side by side.
Indices postorder(const Indices& parent) {
    const std::size_t n = parent.size();
    Indices size(n, 1);  // of the subtree
    for (std::size_t j = 0; j < n; ++j) {
        if (parent[j] >= 0) size[static_cast<std::size_t>(parent[j])] += size[j];
    }
    Indices place(n, 0);
    Indices free_end(n, 0);  // where the places still free in the subtree of a column end
    auto free_end_of_roots = static_cast<int>(n);
    for (std::size_t k = n; k-- > 0;) {
        int& end = parent[k] < 0 ? free_end_of_roots : free_end[static_cast<std::size_t>(parent[k])];
        place[k] = end - 1;
        free_end[k] = end - 1;
        end -= size[k];
    }
    return place;
}

bool samePattern(const Matrix& a, const Matrix& b) {
    return a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
           std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1, b.outerIndexPtr()) &&
           std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

/// Columns first .. end of the factor, all with the same rows below.
struct Supernode {
    Index first = 0;
    Index end = 0;
    const int* rows = nullptr;  ///< below, rising
    Index row_count = 0;
    [[nodiscard]] Index width() const { return end - first; }
};

std::vector<Supernode> supernodesOf(const Matrix& L) {
    // Wider ones would only cost memory for the dense blocks above their diagonal.
    constexpr Index kWidest = 128;
    std::vector<Supernode> supernodes;
    const int* begins = L.outerIndexPtr();
    for (Index j = 0; j < L.cols(); ++j) {
        const bool joins = !supernodes.empty() && supernodes.back().width() < kWidest &&
                           begins[j + 1] - begins[j] == begins[j] - begins[j - 1] - 1 &&
                           L.innerIndexPtr()[begins[j - 1] + 1] == j;
        if (!joins) supernodes.push_back({j, j, nullptr, 0});
        Supernode& last = supernodes.back();
        last.end = j + 1;
        last.rows = L.innerIndexPtr() + begins[j] + 1;
        last.row_count = begins[j + 1] - begins[j] - 1;
    }
    return supernodes;
}

}  // namespace

struct SelectedInverse::Blocks {
    /// The pattern of the factor, values yet to come.
    Blocks(const Indices& places, const Matrix& L)
        : place(places), supernodes(supernodesOf(L)), supernode_of(places.size()), values(supernodes.size()) {
        std::size_t row_count = 0;
        for (const Supernode& node : supernodes) row_count += static_cast<std::size_t>(node.row_count);
        rows.reserve(row_count);
        for (std::size_t s = 0; s < supernodes.size(); ++s) {
            Supernode& node = supernodes[s];
            const int* copied = rows.data() + rows.size();
            rows.insert(rows.end(), node.rows, node.rows + node.row_count);
            node.rows = copied;
            std::fill(supernode_of.begin() + node.first, supernode_of.begin() + node.end, s);
        }
    }
    Blocks(const Blocks&) = delete;  // supernodes point into it
    Blocks& operator=(const Blocks&) = delete;

    Indices place;
    std::vector<Supernode> supernodes;  ///< their rows point into `rows`
    Indices rows;
    std::vector<std::size_t> supernode_of;  ///< of each column
    /// Of each supernode: its own rows and columns, then the rows below. The first square is full.
    std::vector<Eigen::MatrixXd> values;

    /// Row of an unknown in the block of a supernode; nothing below 0.
    [[nodiscard]] Index rowIn(const Supernode& node, int unknown) const {
        if (unknown < node.end) return unknown - node.first;
        const int* found = std::lower_bound(node.rows, node.rows + node.row_count, unknown);
        if (found == node.rows + node.row_count || *found != unknown) return -1;
        return node.width() + (found - node.rows);
    }

    /// The inverse at the rows below a supernode, lower triangle, from the blocks of its ancestors.
    void gatherBelow(const Supernode& node, std::vector<Index>& row_in_block, Eigen::MatrixXd& Z) const {
        Z.resize(node.row_count, node.row_count);
        for (Index from = 0; from < node.row_count;) {
            const std::size_t above = supernode_of[static_cast<std::size_t>(node.rows[from])];
            const Supernode& ancestor = supernodes[above];
            const Eigen::MatrixXd& block = values[above];
            Index to = from;
            while (to < node.row_count && node.rows[to] < ancestor.end) ++to;
            // Every row below is one of the ancestor's; both rise.
            row_in_block.resize(static_cast<std::size_t>(node.row_count - from));
            const int* seek = ancestor.rows;
            for (Index i = from; i < node.row_count; ++i) {
                Index& row = row_in_block[static_cast<std::size_t>(i - from)];
                if (i < to) {
                    row = node.rows[i] - ancestor.first;
                } else {
                    while (*seek != node.rows[i]) ++seek;
                    row = ancestor.width() + (seek - ancestor.rows);
                }
            }
            for (Index j = from; j < to; ++j) {
                const double* column = block.col(node.rows[j] - ancestor.first).data();
                for (Index i = j; i < node.row_count; ++i) {
                    Z(i, j) = column[row_in_block[static_cast<std::size_t>(i - from)]];
                }
            }
            from = to;
        }
    }
};

SelectedInverse::SelectedInverse(std::shared_ptr<const Blocks> blocks) : blocks_(std::move(blocks)) {}

double SelectedInverse::at(Index i, Index j) const {
    const Indices& place = blocks_->place;
    assert(i >= 0 && j >= 0 && static_cast<std::size_t>(std::max(i, j)) < place.size());
    const int a = place[static_cast<std::size_t>(i)];
    const int b = place[static_cast<std::size_t>(j)];
    const int row = std::max(a, b);
    const int column = std::min(a, b);
    const std::size_t node = blocks_->supernode_of[static_cast<std::size_t>(column)];
    const Index row_in_block = blocks_->rowIn(blocks_->supernodes[node], row);
    if (row_in_block < 0) return std::numeric_limits<double>::quiet_NaN();
    return blocks_->values[node](row_in_block, column - blocks_->supernodes[node].first);
}

Eigen::VectorXd SelectedInverse::diagonal() const {
    Eigen::VectorXd diagonal(static_cast<Index>(blocks_->place.size()));
    for (Index i = 0; i < diagonal.size(); ++i) diagonal[i] = at(i, i);
    return diagonal;
}

struct SparseCholesky::Factor {
    Indices place;
    Matrix upper;  ///< P A P'
    Eigen::SimplicialLLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>> llt;

    [[nodiscard]] const Matrix& L() const { return llt.matrixL().nestedExpression(); }

    /// Numbers the places anew where that makes columns of equal pattern neighbours.
    void analyze(const Matrix& A) {
        const Indices moved = postorder(eliminationTree(upper));
        for (int& p : place) p = moved[static_cast<std::size_t>(p)];
        upper = permutedUpper(A, place);
        llt.analyzePattern(upper);
    }

    /// The system's own number of the unknown at a place.
    [[nodiscard]] Index unknownAt(Index at) const {
        return std::find(place.begin(), place.end(), static_cast<int>(at)) - place.begin();
    }
    [[nodiscard]] tl::unexpected<Error> undetermined(Index at) const {
        return badData(fmt::format("the system of equations does not determine unknown {}", unknownAt(at)));
    }
    [[nodiscard]] double diagonal(Index j) const {
        const Index last = upper.outerIndexPtr()[j + 1] - 1;
        const bool present = last >= upper.outerIndexPtr()[j] && upper.innerIndexPtr()[last] == j;
        return present ? upper.valuePtr()[last] : 0.0;
    }

    Result<void> factorizeNumbers() {
        for (Index k = 0; k < upper.nonZeros(); ++k) {
            if (!std::isfinite(upper.valuePtr()[k])) {
                return badData("the system of equations holds a number that is not finite");
            }
        }
        for (Index j = 0; j < upper.cols(); ++j) {
            if (!(diagonal(j) > 0.0)) return undetermined(j);
        }
        llt.factorize(upper);
        if (llt.info() != Eigen::Success) return badData("the system of equations is not positive definite");
        for (Index j = 0; j < upper.cols(); ++j) {
            const double pivot = L().valuePtr()[L().outerIndexPtr()[j]];
            const double least = 64.0 * std::numeric_limits<double>::epsilon() * diagonal(j);
            if (!(pivot * pivot > least)) return undetermined(j);
        }
        return {};
    }
};

SparseCholesky::SparseCholesky(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;
SparseCholesky::~SparseCholesky() = default;

Result<SparseCholesky> SparseCholesky::factorize(const Matrix& A) {
    assert(A.rows() == A.cols());
    auto factor = std::make_unique<Factor>();
    factor->place = dissect(A);
    factor->upper = permutedUpper(A, factor->place);
    factor->analyze(A);
    if (auto done = factor->factorizeNumbers(); !done) return tl::unexpected(done.error());
    return SparseCholesky(std::move(factor));
}

Result<void> SparseCholesky::refactorize(const Matrix& A) {
    assert(A.rows() == A.cols() && A.cols() == factor_->upper.cols());
    Matrix upper = permutedUpper(A, factor_->place);
    const bool same = samePattern(upper, factor_->upper);
    factor_->upper = std::move(upper);
    if (!same) factor_->analyze(A);
    return factor_->factorizeNumbers();
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& b) const {
    const auto P = permutationOf(factor_->place);
    const Eigen::VectorXd permuted = P * b;
    const Eigen::VectorXd x = factor_->llt.solve(permuted);
    return P.transpose() * x;
}

double SparseCholesky::logDeterminant() const {
    double sum = 0.0;
    for (Index j = 0; j < factor_->L().cols(); ++j) {
        sum += std::log(factor_->L().valuePtr()[factor_->L().outerIndexPtr()[j]]);
    }
    return 2.0 * sum;
}

Index SparseCholesky::factorNonZeros() const {
    return factor_->L().nonZeros();
}

SelectedInverse SparseCholesky::selectedInverse() const {
    const Matrix& L = factor_->L();
    auto inverse = std::make_shared<SelectedInverse::Blocks>(factor_->place, L);
    Eigen::MatrixXd L_JJ, Y, Z_RR;
    std::vector<Index> row_in_block;
    for (std::size_t s = inverse->supernodes.size(); s-- > 0;) {
        const Supernode& node = inverse->supernodes[s];
        const Index width = node.width();
        L_JJ.setZero(width, width);
        Y.resize(node.row_count, width);
        for (Index k = 0; k < width; ++k) {
            const double* column = L.valuePtr() + L.outerIndexPtr()[node.first + k];
            std::copy(column, column + (width - k), L_JJ.col(k).data() + k);
            std::copy(column + (width - k), column + (width - k) + node.row_count, Y.col(k).data());
        }
        const auto triangle = L_JJ.triangularView<Eigen::Lower>();
        const Eigen::MatrixXd L_inverse = triangle.solve(Eigen::MatrixXd::Identity(width, width));
        Eigen::MatrixXd& Z = inverse->values[s];
        Z.resize(width + node.row_count, width);
        Z.topRows(width).noalias() = L_inverse.transpose() * L_inverse;
        if (node.row_count == 0) continue;
        triangle.solveInPlace<Eigen::OnTheRight>(Y);
        inverse->gatherBelow(node, row_in_block, Z_RR);
        Z.bottomRows(node.row_count).noalias() = -(Z_RR.selfadjointView<Eigen::Lower>() * Y);
        Z.topRows(width).noalias() -= Y.transpose() * Z.bottomRows(node.row_count);
    }
    return SelectedInverse(std::move(inverse));
}

}  // namespace terrawalk
