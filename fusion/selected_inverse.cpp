#include "fusion/selected_inverse.hpp"

#include <fmt/format.h>
#include <metis.h>

#include <Eigen/Cholesky>
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

Matrix permutedLower(const Matrix& A, const Indices& place) {
    return permutedUpper(A, place).transpose();
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
    Indices rows;  ///< below, rising
    [[nodiscard]] Index width() const { return end - first; }
    [[nodiscard]] Index rowCount() const { return static_cast<Index>(rows.size()); }
    [[nodiscard]] Index size() const { return width() + rowCount(); }
};

/// Supernodes of the factor of a matrix whose columns are in postorder. A column has the rows of the matrix
/// and those of its children, itself left out; its parent is the first of them. Source: Liu 1990.
std::vector<Supernode> supernodesOf(const Matrix& lower) {
    // Wider ones would only cost memory for the dense blocks above their diagonal.
    constexpr Index kWidest = 128;
    const auto n = static_cast<std::size_t>(lower.cols());
    std::vector<Supernode> supernodes;
    std::vector<Indices> children(n);  // of each column, by supernode; the last supernode is not yet there
    Indices seen(n, -1);
    Indices below;
    for (int j = 0; j < lower.cols(); ++j) {
        below.clear();
        const auto take = [&](int i) {
            if (i <= j || std::exchange(seen[static_cast<std::size_t>(i)], j) == j) return;
            below.push_back(i);
        };
        for (Matrix::InnerIterator entry(lower, j); entry; ++entry) take(static_cast<int>(entry.row()));
        for (const int child : children[static_cast<std::size_t>(j)]) {
            for (const int i : supernodes[static_cast<std::size_t>(child)].rows) take(i);
        }
        const bool goes_on =
            !supernodes.empty() && !supernodes.back().rows.empty() && supernodes.back().rows.front() == j;
        if (goes_on) {
            for (const int i : supernodes.back().rows) take(i);
        }
        if (goes_on && supernodes.back().width() < kWidest &&
            below.size() + 1 == supernodes.back().rows.size()) {
            supernodes.back().end = j + 1;
            supernodes.back().rows.erase(supernodes.back().rows.begin());
            continue;
        }
        if (!supernodes.empty() && !supernodes.back().rows.empty()) {
            children[static_cast<std::size_t>(supernodes.back().rows.front())].push_back(
                static_cast<int>(supernodes.size()) - 1);
        }
        std::sort(below.begin(), below.end());
        supernodes.push_back({j, j + 1, below});
    }
    return supernodes;
}

/// Where a factor and its inverse have entries.
struct Pattern {
    Indices place;  ///< of each unknown in the order of elimination
    std::vector<Supernode> supernodes;
    std::vector<std::size_t> supernode_of;  ///< of each column

    Pattern(Indices places, const Matrix& lower)
        : place(std::move(places)), supernodes(supernodesOf(lower)), supernode_of(place.size()) {
        for (std::size_t s = 0; s < supernodes.size(); ++s) {
            std::fill(supernode_of.begin() + supernodes[s].first, supernode_of.begin() + supernodes[s].end,
                      s);
        }
    }

    /// Row of a place in the block of a supernode; nothing below 0.
    [[nodiscard]] static Index rowIn(const Supernode& node, int at) {
        if (at < node.end) return at - node.first;
        const auto found = std::lower_bound(node.rows.begin(), node.rows.end(), at);
        if (found == node.rows.end() || *found != at) return -1;
        return node.width() + (found - node.rows.begin());
    }

    /// Rows of `node` from the `from`-th on as rows in the block of an ancestor, which has them all.
    static void rowsIn(const Supernode& ancestor, const Supernode& node, Index from,
                       std::vector<Index>& rows) {
        rows.resize(static_cast<std::size_t>(node.rowCount() - from));
        auto seek = ancestor.rows.begin();
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const int at = node.rows[static_cast<std::size_t>(from) + k];
            if (at < ancestor.end) {
                rows[k] = at - ancestor.first;
            } else {
                while (*seek != at) ++seek;  // both rise
                rows[k] = ancestor.width() + (seek - ancestor.rows.begin());
            }
        }
    }
};

}  // namespace

struct SelectedInverse::Blocks {
    std::shared_ptr<const Pattern> pattern;
    /// Of each supernode: its own rows and columns, then the rows below. The first square is full.
    std::vector<Eigen::MatrixXd> values;

    /// The inverse at the rows below a supernode, lower triangle, from the blocks of its ancestors.
    void gatherBelow(const Supernode& node, std::vector<Index>& row_in_block, Eigen::MatrixXd& Z) const {
        const Index count = node.rowCount();
        Z.resize(count, count);
        for (Index from = 0; from < count;) {
            const std::size_t above =
                pattern->supernode_of[static_cast<std::size_t>(node.rows[static_cast<std::size_t>(from)])];
            const Supernode& ancestor = pattern->supernodes[above];
            Pattern::rowsIn(ancestor, node, from, row_in_block);
            Index j = from;
            for (; j < count && row_in_block[static_cast<std::size_t>(j - from)] < ancestor.width(); ++j) {
                const double* column =
                    values[above].col(row_in_block[static_cast<std::size_t>(j - from)]).data();
                for (Index i = j; i < count; ++i) {
                    Z(i, j) = column[row_in_block[static_cast<std::size_t>(i - from)]];
                }
            }
            from = j;
        }
    }
};

SelectedInverse::SelectedInverse(std::shared_ptr<const Blocks> blocks) : blocks_(std::move(blocks)) {}

double SelectedInverse::at(Index i, Index j) const {
    const Pattern& pattern = *blocks_->pattern;
    assert(i >= 0 && j >= 0 && static_cast<std::size_t>(std::max(i, j)) < pattern.place.size());
    const int a = pattern.place[static_cast<std::size_t>(i)];
    const int b = pattern.place[static_cast<std::size_t>(j)];
    const int row = std::max(a, b);
    const int column = std::min(a, b);
    const std::size_t node = pattern.supernode_of[static_cast<std::size_t>(column)];
    const Index row_in_block = Pattern::rowIn(pattern.supernodes[node], row);
    if (row_in_block < 0) return std::numeric_limits<double>::quiet_NaN();
    return blocks_->values[node](row_in_block, column - pattern.supernodes[node].first);
}

Eigen::VectorXd SelectedInverse::diagonal() const {
    Eigen::VectorXd diagonal(static_cast<Index>(blocks_->pattern->place.size()));
    for (Index i = 0; i < diagonal.size(); ++i) diagonal[i] = at(i, i);
    return diagonal;
}

struct SparseCholesky::Factor {
    Matrix lower;  ///< P A P'
    std::shared_ptr<const Pattern> pattern;
    /// Of each supernode: its own rows and columns, lower triangle, then the rows below.
    std::vector<Eigen::MatrixXd> blocks;

    /// Numbers the places anew where that makes columns of equal pattern neighbours.
    void analyze(const Matrix& A, Indices place) {
        const Indices moved = postorder(eliminationTree(permutedUpper(A, place)));
        for (int& p : place) p = moved[static_cast<std::size_t>(p)];
        lower = permutedLower(A, place);
        pattern = std::make_shared<const Pattern>(std::move(place), lower);
    }

    /// The system's own number of the unknown at a place.
    [[nodiscard]] Index unknownAt(Index at) const {
        const Indices& place = pattern->place;
        return std::find(place.begin(), place.end(), static_cast<int>(at)) - place.begin();
    }
    [[nodiscard]] tl::unexpected<Error> undetermined(Index at) const {
        return badData(fmt::format("the system of equations does not determine unknown {}", unknownAt(at)));
    }
    [[nodiscard]] double diagonal(Index j) const {
        const Index first = lower.outerIndexPtr()[j];
        const bool present = first < lower.outerIndexPtr()[j + 1] && lower.innerIndexPtr()[first] == j;
        return present ? lower.valuePtr()[first] : 0.0;
    }

    /// What a supernode leaves to the rows below it, until its parent takes that.
    struct Update {
        std::size_t node;
        Eigen::MatrixXd values;  ///< lower triangle
    };

    /// Multifrontal: the columns of a supernode and the rows below are one dense matrix, in which the
    /// children's updates are summed up. Source: Duff and Reid 1983; Liu 1992.
    Result<void> factorizeNumbers(const std::stop_token& stop) {
        for (Index k = 0; k < lower.nonZeros(); ++k) {
            if (!std::isfinite(lower.valuePtr()[k])) {
                return badData("the system of equations holds a number that is not finite");
            }
        }
        for (Index j = 0; j < lower.cols(); ++j) {
            if (!(diagonal(j) > 0.0)) return undetermined(j);
        }
        blocks.resize(pattern->supernodes.size());
        std::vector<Update> updates;  // in postorder the children's are the last
        Eigen::MatrixXd front;
        std::vector<Index> rows;
        for (std::size_t s = 0; s < blocks.size(); ++s) {
            if (stop.stop_requested()) return cancelled();
            const Supernode& node = pattern->supernodes[s];
            front.setZero(node.size(), node.size());
            for (Index j = node.first; j < node.end; ++j) {
                for (Matrix::InnerIterator entry(lower, j); entry; ++entry) {
                    front(Pattern::rowIn(node, static_cast<int>(entry.row())), j - node.first) =
                        entry.value();
                }
            }
            while (!updates.empty() && parentOf(updates.back().node) == s) {
                addUpdate(updates.back(), node, rows, front);
                updates.pop_back();
            }
            if (auto done = eliminate(node, front); !done) return done;
            blocks[s] = front.leftCols(node.width());
            if (node.rowCount() > 0) {
                updates.push_back({s, front.bottomRightCorner(node.rowCount(), node.rowCount())});
            }
        }
        return {};
    }

    [[nodiscard]] std::size_t parentOf(std::size_t s) const {
        return pattern->supernode_of[static_cast<std::size_t>(pattern->supernodes[s].rows.front())];
    }

    void addUpdate(const Update& update, const Supernode& node, std::vector<Index>& rows,
                   Eigen::MatrixXd& front) const {
        Pattern::rowsIn(node, pattern->supernodes[update.node], 0, rows);
        for (std::size_t j = 0; j < rows.size(); ++j) {
            double* column = front.col(rows[j]).data();
            const double* added = update.values.col(static_cast<Index>(j)).data();
            for (std::size_t i = j; i < rows.size(); ++i) column[rows[i]] += added[i];
        }
    }

    /// The columns of the node become those of the factor, the rest its update.
    Result<void> eliminate(const Supernode& node, Eigen::MatrixXd& front) const {
        const Index width = node.width();
        const Index below = node.rowCount();
        Eigen::Ref<Eigen::MatrixXd> own = front.topLeftCorner(width, width);
        const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(own);
        if (llt.info() != Eigen::Success) return badData("the system of equations is not positive definite");
        for (Index k = 0; k < width; ++k) {
            const double least = 64.0 * std::numeric_limits<double>::epsilon() * diagonal(node.first + k);
            if (!(own(k, k) * own(k, k) > least)) return undetermined(node.first + k);
        }
        if (below == 0) return {};
        Eigen::Ref<Eigen::MatrixXd> rows = front.bottomLeftCorner(below, width);
        own.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(rows);
        front.bottomRightCorner(below, below).selfadjointView<Eigen::Lower>().rankUpdate(rows, -1.0);
        return {};
    }
};

SparseCholesky::SparseCholesky(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;
SparseCholesky::~SparseCholesky() = default;

Result<SparseCholesky> SparseCholesky::factorize(const Matrix& A, const std::stop_token& stop) {
    assert(A.rows() == A.cols());
    auto factor = std::make_unique<Factor>();
    factor->analyze(A, dissect(A));
    if (auto done = factor->factorizeNumbers(stop); !done) return tl::unexpected(done.error());
    return SparseCholesky(std::move(factor));
}

Result<void> SparseCholesky::refactorize(const Matrix& A, const std::stop_token& stop) {
    assert(A.rows() == A.cols() && A.cols() == factor_->lower.cols());
    Matrix lower = permutedLower(A, factor_->pattern->place);
    if (samePattern(lower, factor_->lower)) {
        factor_->lower = std::move(lower);
    } else {
        factor_->analyze(A, factor_->pattern->place);
    }
    return factor_->factorizeNumbers(stop);
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& b) const {
    const Pattern& pattern = *factor_->pattern;
    const auto P = permutationOf(pattern.place);
    Eigen::VectorXd x = P * b;
    Eigen::VectorXd below;
    for (std::size_t s = 0; s < pattern.supernodes.size(); ++s) {
        const Supernode& node = pattern.supernodes[s];
        const Eigen::MatrixXd& L = factor_->blocks[s];
        auto own = x.segment(node.first, node.width());
        L.topRows(node.width()).triangularView<Eigen::Lower>().solveInPlace(own);
        below.noalias() = L.bottomRows(node.rowCount()) * own;
        for (std::size_t i = 0; i < node.rows.size(); ++i) x[node.rows[i]] -= below[static_cast<Index>(i)];
    }
    for (std::size_t s = pattern.supernodes.size(); s-- > 0;) {
        const Supernode& node = pattern.supernodes[s];
        const Eigen::MatrixXd& L = factor_->blocks[s];
        auto own = x.segment(node.first, node.width());
        below.resize(node.rowCount());
        for (std::size_t i = 0; i < node.rows.size(); ++i) below[static_cast<Index>(i)] = x[node.rows[i]];
        own.noalias() -= L.bottomRows(node.rowCount()).transpose() * below;
        L.topRows(node.width()).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
    }
    return P.transpose() * x;
}

double SparseCholesky::logDeterminant() const {
    double sum = 0.0;
    for (std::size_t s = 0; s < factor_->blocks.size(); ++s) {
        for (Index k = 0; k < factor_->pattern->supernodes[s].width(); ++k) {
            sum += std::log(factor_->blocks[s](k, k));
        }
    }
    return 2.0 * sum;
}

Index SparseCholesky::factorNonZeros() const {
    Index count = 0;
    for (const Supernode& node : factor_->pattern->supernodes) {
        count += node.width() * (node.width() + 1) / 2 + node.width() * node.rowCount();
    }
    return count;
}

Result<SelectedInverse> SparseCholesky::selectedInverse(const std::stop_token& stop) const {
    auto inverse = std::make_shared<SelectedInverse::Blocks>();
    inverse->pattern = factor_->pattern;
    inverse->values.resize(factor_->blocks.size());
    Eigen::MatrixXd Y, Z_RR;
    std::vector<Index> row_in_block;
    for (std::size_t s = inverse->values.size(); s-- > 0;) {
        if (stop.stop_requested()) return cancelled();
        const Supernode& node = factor_->pattern->supernodes[s];
        const Index width = node.width();
        const auto triangle = factor_->blocks[s].topRows(width).triangularView<Eigen::Lower>();
        const Eigen::MatrixXd L_inverse = triangle.solve(Eigen::MatrixXd::Identity(width, width));
        Eigen::MatrixXd& Z = inverse->values[s];
        Z.resize(node.size(), width);
        Z.topRows(width).noalias() = L_inverse.transpose() * L_inverse;
        if (node.rowCount() == 0) continue;
        Y = factor_->blocks[s].bottomRows(node.rowCount());
        triangle.solveInPlace<Eigen::OnTheRight>(Y);
        inverse->gatherBelow(node, row_in_block, Z_RR);
        Z.bottomRows(node.rowCount()).noalias() = -(Z_RR.selfadjointView<Eigen::Lower>() * Y);
        Z.topRows(width).noalias() -= Y.transpose() * Z.bottomRows(node.rowCount());
    }
    return SelectedInverse(std::move(inverse));
}

}  // namespace terrawalk
