#pragma once
/// Scalar copulas of dimension 2 as a textbook has them, with the C library: the baseline of the benchmarks. No care is
/// taken of cancellation or overflow. Formulas: generators of Nelsen 2006, table 4.1, differentiated by hand; inverse
/// of the conditional in closed form where there is one, else Newton's method kept inside a bracket.

#include <cmath>

namespace sklar::textbook {

struct Frank {
  double theta;

  double log_pdf(double u, double v) const {
    const double a = 1 - std::exp(-theta);
    const double x = 1 - std::exp(-theta * u);
    const double y = 1 - std::exp(-theta * v);
    return std::log(theta * a) - theta * (u + v) - 2 * std::log(a - x * y);
  }
  double h_inv(double u, double p) const {
    const double e = std::exp(-theta * u);
    return -std::log(1 - p * (1 - std::exp(-theta)) / (e + p * (1 - e))) / theta;
  }
};

struct Clayton {
  double theta;

  double log_pdf(double u, double v) const {
    const double s = std::pow(u, -theta) + std::pow(v, -theta) - 1;
    return std::log(1 + theta) - (1 + theta) * std::log(u * v) - (2 + 1 / theta) * std::log(s);
  }
  double h_inv(double u, double p) const {
    return std::pow((std::pow(p, -theta / (1 + theta)) - 1) * std::pow(u, -theta) + 1, -1 / theta);
  }
};

/// Ali-Mikhail-Haq; the inverse is a root of a quadratic in 1 - v.
struct Amh {
  double theta;

  double log_pdf(double u, double v) const {
    const double uv = (1 - u) * (1 - v);
    return std::log(1 + theta * ((1 + u) * (1 + v) - 3) + theta * theta * uv) - 3 * std::log(1 - theta * uv);
  }
  double h_inv(double u, double p) const {
    const double b = theta * (1 - u);
    const double middle = 1 + theta - 2 * p * b;
    const double last = 1 - p;
    return 1 - 2 * last / (middle + std::sqrt(middle * middle - 4 * (theta - p * b * b) * last));
  }
};

/// The v with copula.h(u, v) = p.
template <class Copula>
double root(const Copula& copula, double u, double p) {
  double low = 0, high = 1, v = p;
  for (int step = 0; step < 100; ++step) {
    const double miss = copula.h(u, v) - p;
    (miss < 0 ? low : high) = v;
    double next = v - miss / std::exp(copula.log_pdf(u, v));
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - v) <= 1e-9 * v) return next;  // the next step, squared, is below a rounding
    v = next;
  }
  return v;
}

struct Gumbel {
  double theta;

  double log_pdf(double u, double v) const {
    const double x = -std::log(u);
    const double y = -std::log(v);
    const double s = std::pow(x, theta) + std::pow(y, theta);
    const double r = std::pow(s, 1 / theta);
    return -r + x + y + (theta - 1) * std::log(x * y) + (1 / theta - 2) * std::log(s) + std::log(r + theta - 1);
  }
  double h(double u, double v) const {
    const double x = -std::log(u);
    const double s = std::pow(x, theta) + std::pow(-std::log(v), theta);
    const double r = std::pow(s, 1 / theta);
    return std::exp(-r) / u * std::pow(x, theta - 1) * r / s;
  }
  double h_inv(double u, double p) const { return root(*this, u, p); }
};

struct Joe {
  double theta;

  double log_pdf(double u, double v) const {
    const double x = std::pow(1 - u, theta);
    const double y = std::pow(1 - v, theta);
    const double s = x + y - x * y;
    return (1 / theta - 2) * std::log(s) + (theta - 1) * std::log((1 - u) * (1 - v)) + std::log(theta - 1 + s);
  }
  double h(double u, double v) const {
    const double x = std::pow(1 - u, theta);
    const double y = std::pow(1 - v, theta);
    return std::pow(x + y - x * y, 1 / theta - 1) * std::pow(1 - u, theta - 1) * (1 - y);
  }
  double h_inv(double u, double p) const { return root(*this, u, p); }
};

}  // namespace sklar::textbook
