#include "copula/random.hpp"

#include <algorithm>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "copula/random.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sklar::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Word = std::uint64_t;

/// The recurrence of Nishimura (2000), eq. 1, and its tempering.
template <class D>
HWY_INLINE hn::Vec<D> twisted(D d, const Word* here, const Word* there) {
  const auto upper = hn::Set(d, 0xffffffff80000000U), one = hn::Set(d, Word{1});
  const auto current = hn::LoadU(d, here), next = hn::LoadU(d, here + 1);
  const auto y = hn::Or(hn::And(current, upper), hn::AndNot(upper, next));
  const auto odd = hn::Eq(hn::And(next, one), one);
  const auto matrix = hn::IfThenElseZero(odd, hn::Set(d, 0xb5026f5aa96619e9U));
  return hn::Xor(hn::Xor(hn::LoadU(d, there), hn::ShiftRight<1>(y)), matrix);
}

template <class D>
HWY_INLINE hn::Vec<D> tempered(D d, hn::Vec<D> x) {
  x = hn::Xor(x, hn::And(hn::ShiftRight<29>(x), hn::Set(d, 0x5555555555555555U)));
  x = hn::Xor(x, hn::And(hn::ShiftLeft<17>(x), hn::Set(d, 0x71d67fffeda60000U)));
  x = hn::Xor(x, hn::And(hn::ShiftLeft<37>(x), hn::Set(d, 0xfff7eee000000000U)));
  return hn::Xor(x, hn::ShiftRight<43>(x));
}

/// step(tag, i) for i from first to last in vectors and then one by one.
template <class Step>
HWY_INLINE void in_vectors(std::size_t first, std::size_t last, const Step& step) {
  const hn::ScalableTag<Word> d;
  for (; first + hn::Lanes(d) <= last; first += hn::Lanes(d)) step(d, first);
  for (; first < last; ++first) step(hn::CappedTag<Word, 1>(), first);
}

/// @param state size + 1 words, of which the last is for use here. @param shift below size.
void next_numbers(Word* state, Word* numbers, std::size_t size, std::size_t shift) {
  in_vectors(0, size - shift, [&](auto d, std::size_t i) HWY_ATTR {
    hn::StoreU(twisted(d, state + i, state + i + shift), d, state + i);
  });
  state[size] = state[0];
  in_vectors(size - shift, size, [&](auto d, std::size_t i) HWY_ATTR {
    hn::StoreU(twisted(d, state + i, state + i + shift - size), d, state + i);
  });
  in_vectors(0, size,
             [&](auto d, std::size_t i) HWY_ATTR { hn::StoreU(tempered(d, hn::LoadU(d, state + i)), d, numbers + i); });
}

}  // namespace sklar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar {

HWY_EXPORT(next_numbers);

Rng::Rng(result_type seed) : numbers_{} {
  state_[0] = seed;
  for (std::size_t i = 1; i < kSize; ++i) {
    state_[i] = 6364136223846793005U * (state_[i - 1] ^ state_[i - 1] >> 62) + i;
  }
  state_[kSize] = 0;
}

void Rng::refill() {
  constexpr std::size_t kShift = 156;
  HWY_DYNAMIC_DISPATCH(next_numbers)(state_.data(), numbers_.data(), kSize, kShift);
  next_ = 0;
}

void fill_uniforms(Rng& rng, PointsOut w) {
  constexpr Index kBlock = 64;  // rows, turned into columns in the innermost cache
  std::vector<double> block(static_cast<std::size_t>(std::min(kBlock, w.rows()) * w.cols()));
  for (Index first = 0; first < w.rows(); first += kBlock) {
    const Index rows = std::min(kBlock, w.rows() - first);
    for (Index i = 0; i < rows * w.cols(); ++i) block[static_cast<std::size_t>(i)] = uniform(rng);
    w.middleRows(first, rows) = Eigen::Map<const Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        block.data(), rows, w.cols());
  }
}

Points uniforms(Rng& rng, Index rows, Index columns) {
  Points w(rows, columns);
  fill_uniforms(rng, w);
  return w;
}

}  // namespace sklar
#endif
