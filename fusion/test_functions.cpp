#include "fusion/test_functions.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "fusion/random_numbers.hpp"

namespace terrawalk {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

double sphere(std::span<const double> x) {
    double sum = 0.0;
    for (const double v : x) sum += v * v;
    return sum;
}

double ackley(std::span<const double> x) {
    const double n = static_cast<double>(x.size());
    double squares = 0.0;
    double cosines = 0.0;
    for (const double v : x) {
        squares += v * v;
        cosines += std::cos(kTwoPi * v);
    }
    return -20.0 * std::exp(-0.2 * std::sqrt(squares / n)) - std::exp(cosines / n) + 20.0 + std::numbers::e;
}

double rastrigin(std::span<const double> x) {
    double sum = 0.0;
    for (const double v : x) sum += v * v - 10.0 * std::cos(kTwoPi * v) + 10.0;
    return sum;
}

double rosenbrock(std::span<const double> x) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        const double valley = x[i + 1] - x[i] * x[i];
        sum += 100.0 * valley * valley + (1.0 - x[i]) * (1.0 - x[i]);
    }
    return sum;
}

double griewank(std::span<const double> x) {
    double sum = 0.0;
    double product = 1.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sum += x[i] * x[i];
        product *= std::cos(x[i] / std::sqrt(static_cast<double>(i + 1)));
    }
    return sum / 4000.0 - product + 1.0;
}

double levy13(std::span<const double> x) {
    const auto squaredSine = [](double v) {
        return std::sin(v) * std::sin(v);
    };
    const double a = x[0] - 1.0;
    const double b = x[1] - 1.0;
    return squaredSine(3.0 * std::numbers::pi * x[0]) +
           a * a * (1.0 + squaredSine(3.0 * std::numbers::pi * x[1])) +
           b * b * (1.0 + squaredSine(kTwoPi * x[1]));
}

double halfWidth(TestFunction function) {
    switch (function) {
        case TestFunction::Sphere:
            return 100.0;
        case TestFunction::Ackley:
            return 32.0;
        case TestFunction::Rastrigin:
            return 5.12;
        case TestFunction::Rosenbrock:
            return 30.0;
        case TestFunction::Griewank:
            return 600.0;
        case TestFunction::Levy13:
            return 10.0;
    }
    return 1.0;
}

}  // namespace

std::string_view name(TestFunction function) {
    return kTestFunctionNames[static_cast<std::size_t>(function)].second;
}

double evaluate(TestFunction function, std::span<const double> x) {
    switch (function) {
        case TestFunction::Sphere:
            return sphere(x);
        case TestFunction::Ackley:
            return ackley(x);
        case TestFunction::Rastrigin:
            return rastrigin(x);
        case TestFunction::Rosenbrock:
            return rosenbrock(x);
        case TestFunction::Griewank:
            return griewank(x);
        case TestFunction::Levy13:
            return levy13(x);
    }
    return 0.0;
}

double minimiser(TestFunction function) {
    return function == TestFunction::Rosenbrock || function == TestFunction::Levy13 ? 1.0 : 0.0;
}

SearchBox usualBox(TestFunction function, std::size_t dimensions) {
    const double half = halfWidth(function);
    return {std::vector<double>(dimensions, -half), std::vector<double>(dimensions, half)};
}

double ShiftedFunction::operator()(std::span<const double> x) const {
    thread_local std::vector<double> moved;
    moved.resize(x.size());
    for (std::size_t j = 0; j < x.size(); ++j) moved[j] = x[j] - shift[j];
    return evaluate(function, moved);
}

ShiftedFunction shifted(TestFunction function, std::size_t dimensions, std::uint64_t seed) {
    RandomNumbers random({seed, static_cast<std::uint64_t>(function), dimensions});
    ShiftedFunction moved = unshifted(function, dimensions);
    const double reach = 0.8 * halfWidth(function);
    for (double& shift : moved.shift) shift = random.uniform(-reach, reach) - minimiser(function);
    return moved;
}

ShiftedFunction unshifted(TestFunction function, std::size_t dimensions) {
    return {function, std::vector<double>(dimensions, 0.0)};
}

Objective objectiveOf(const ShiftedFunction& function) {
    return {perCandidate(function.shift.size(), function, std::numeric_limits<std::size_t>::max())};
}

}  // namespace terrawalk
