#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "fusion/optimiser.hpp"

namespace terrawalk {

/// Functions on which optimisers are compared. Each has the least value 0.
/// Source: Jamil and Yang 2013; paper 000, Fig 7 (Griewank, Levy 13); paper 001, Table 1.
enum class TestFunction { Sphere, Ackley, Rastrigin, Rosenbrock, Griewank, Levy13 };

inline constexpr std::array<std::pair<TestFunction, std::string_view>, 6> kTestFunctionNames{{
    {TestFunction::Sphere, "sphere"},
    {TestFunction::Ackley, "ackley"},
    {TestFunction::Rastrigin, "rastrigin"},
    {TestFunction::Rosenbrock, "rosenbrock"},
    {TestFunction::Griewank, "griewank"},
    {TestFunction::Levy13, "levy13"},
}};
[[nodiscard]] std::string_view name(TestFunction function);

/// Pure. Levy13 looks at the first two coordinates alone.
[[nodiscard]] double evaluate(TestFunction function, std::span<const double> x);

/// Where the least value lies: 1 in every coordinate for Rosenbrock and Levy13, 0 for the others.
[[nodiscard]] double minimiser(TestFunction function);

/// The usual box: +-100 Sphere, +-32 Ackley, +-5.12 Rastrigin, +-30 Rosenbrock, +-600 Griewank, +-10 Levy13.
[[nodiscard]] SearchBox usualBox(TestFunction function, std::size_t dimensions);

/// A function moved by x -> x - shift. Many optimisers draw towards the middle of the box or a corner of it
/// and look good on a function whose minimum happens to lie there.
struct ShiftedFunction {
    TestFunction function = TestFunction::Sphere;
    std::vector<double> shift;  ///< d values; zeros: the function itself
    [[nodiscard]] double operator()(std::span<const double> x) const;
};

/// The minimum moved to a random place in the middle four fifths of the usual box, which the seed decides.
[[nodiscard]] ShiftedFunction shifted(TestFunction function, std::size_t dimensions, std::uint64_t seed);
[[nodiscard]] ShiftedFunction unshifted(TestFunction function, std::size_t dimensions);

/// As an objective for `optimise`, evaluated on the calling thread.
[[nodiscard]] Objective objectiveOf(const ShiftedFunction& function);

}  // namespace terrawalk
