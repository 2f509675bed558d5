#include "fusion/good_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace terrawalk {

namespace {

bool isPrime(std::size_t n) {
    if (n < 2) return false;
    for (std::size_t divisor = 2; divisor * divisor <= n; ++divisor) {
        if (n % divisor == 0) return false;
    }
    return true;
}

}  // namespace

std::vector<double> goodPoints(std::size_t n, std::size_t dimensions) {
    std::size_t e = 2 * dimensions + 3;
    while (!isPrime(e)) ++e;
    std::vector<double> r(dimensions);
    for (std::size_t j = 0; j < dimensions; ++j) {
        r[j] = 2.0 * std::cos(2.0 * std::numbers::pi * static_cast<double>(j + 1) / static_cast<double>(e));
    }
    std::vector<double> points(n * dimensions);
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t j = 0; j < dimensions; ++j) {
            const double multiple = static_cast<double>(k + 1) * r[j];
            points[k * dimensions + j] = multiple - std::floor(multiple);
        }
    }
    return points;
}

double centredDiscrepancy(const std::vector<double>& points, std::size_t dimensions) {
    const std::size_t n = points.size() / dimensions;
    const auto at = [&](std::size_t k, std::size_t j) {
        return points[k * dimensions + j] - 0.5;
    };
    double single = 0.0;
    double pairs = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        double product = 1.0;
        for (std::size_t j = 0; j < dimensions; ++j) {
            const double c = std::abs(at(k, j));
            product *= 1.0 + 0.5 * c - 0.5 * c * c;
        }
        single += product;
        for (std::size_t l = 0; l < n; ++l) {
            double of_pair = 1.0;
            for (std::size_t j = 0; j < dimensions; ++j) {
                of_pair *= 1.0 + 0.5 * std::abs(at(k, j)) + 0.5 * std::abs(at(l, j)) -
                           0.5 * std::abs(at(k, j) - at(l, j));
            }
            pairs += of_pair;
        }
    }
    const double count = static_cast<double>(n);
    const double squared = std::pow(13.0 / 12.0, static_cast<double>(dimensions)) - 2.0 / count * single +
                           pairs / (count * count);
    return std::sqrt(std::max(0.0, squared));
}

}  // namespace terrawalk
