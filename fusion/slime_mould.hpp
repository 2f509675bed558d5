#pragma once

#include <cstdint>

#include "fusion/candidate_evaluator.hpp"
#include "fusion/optimiser.hpp"

namespace terrawalk {

// The slime mould algorithms. Each hands whole generations to the evaluator and returns when it is over.
// N: population, d: dimensions, s: share of the evaluations that is spent (t/T of the papers), L: loss.
// Candidates that leave the box are set to its border.

/// The slime mould algorithm as published: random start, then each generation moves every individual,
/// whether it gains or not:
///     uniform in the box                             with probability 0.03, else for each dimension
///     best + vb (W_i X_A - X_B)                      with probability tanh |L_i - L_best|
///     vc X_i                                         otherwise
/// vb in +-artanh(1 - s), vc in +-(1 - s), A and B random, W_i = 1 +- r log10((bF - L_i)/(bF - wF) + 1), plus
/// for the better half; bF and wF the best and worst loss of the generation.
/// Source: Li, Chen, Wang, Heidari and Mirjalili 2020; paper 000, eq 21.
void slimeMould(const SearchBox& box, std::size_t population, std::uint64_t seed,
                CandidateEvaluator& evaluator);

/// As paper 000 prints it: a good point set and its opposition lb + ub - p, the better half of both; in each
/// generation the move above for everybody, then for everybody a trial vector P_a + 0.5 (P_b - P_c) with the
/// crossover rate of eq 25 (fitness is -loss, so that better individuals cross over more), kept if better.
/// Two evaluations for each individual and generation.
/// Source: paper 000, eqs 21-26.
void printedSlimeMould(const SearchBox& box, std::size_t population, std::uint64_t seed,
                       CandidateEvaluator& evaluator);

/// The form to use. What the printed one does wrong: it moves unconditionally and so forgets good points,
/// draws towards the origin (vc X_i), and weighs losses by their unit (tanh |L_i - L_best|). Here
///     start   good points and their opposition, the better half of both
///     each generation   N shrinks evenly from the population to 10, the worst leave
///     each individual   F' = 0.1 + 0.9 U with probability 0.1, else its own F; CR' = U and the kind of
///                       crossover likewise
///         donor   with probability 0.1 a slime mould move, for each dimension
///                     uniform in the box       with probability 0.03 (for the individual), else
///                     best + vb (W (X_A - best) - (X_B - best))
///                                              with probability tanh((L_i - L_best)/(L_worst - L_best))
///                     X_i + vc (X_A - X_B)     otherwise
///                 else X_a + F' (X_b - X_c)
///         trial   binomial or exponential crossover of donor and X_i with CR'; kept if not worse; F', CR'
///         and
///                 the kind of crossover kept with a gain
/// The differential evolution in it supplies most of the gain. Exponential crossover, a run of neighbouring
/// dimensions, is the better one where a dimension has to do with its neighbours alone, binomial crossover
/// where it has to do with all.
/// Source: paper 000, eqs 21-26, changed as said; Brest, Greiner, Boskovic, Mernik and Zumer 2006 (F, CR);
/// Storn and Price 1997 (both crossovers).
void improvedSlimeMould(const SearchBox& box, std::size_t population, std::uint64_t seed,
                        CandidateEvaluator& evaluator);

}  // namespace terrawalk
