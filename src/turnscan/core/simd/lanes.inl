// Vectors of kLanes values (the compilers' vector extensions) and what an instruction set does with
// them in one instruction. Included by the body of a kernel, in its anonymous namespace and behind
// kLanes, which is TURNSCAN_NATIVE_LANES or a multiple of it. Lanes are on their own: whatever
// their number, each has the same bits. In masks, which comparisons give, a lane is 0 or -1.

using F = float __attribute__((vector_size(4 * kLanes)));
using I = int __attribute__((vector_size(4 * kLanes)));

constexpr int kNative = TURNSCAN_NATIVE_LANES;
constexpr bool kIsNative = int(kLanes) == kNative;
using NativeF = float __attribute__((vector_size(4 * kNative)));

template <class V = F, class T>
inline V load(const T* from) {
  V v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
template <class T, class V>
inline void store(T* to, const V& v) {
  __builtin_memcpy(to, &v, sizeof v);
}

inline F all(float value) { return value - F{}; }
inline I all(int value) { return value - I{}; }
/// 0, 1, 2, ...
inline I counting() {
  I v;
  for (int k = 0; k < int(kLanes); ++k) v[k] = k;
  return v;
}

inline F real(const I& v) { return __builtin_convertvector(v, F); }
/// Rounded towards zero.
inline I whole(const F& v) { return __builtin_convertvector(v, I); }

inline F absolute(const F& v) { return reinterpret_cast<F>(reinterpret_cast<I>(v) & 0x7fffffff); }
inline F root(const F& v) {
  F out;
  for (int k = 0; k < int(kLanes); ++k) out[k] = __builtin_sqrtf(v[k]);
  return out;
}

/// a < b ? a : b.
template <class V>
inline V smaller(const V& a, const V& b) {
#if TURNSCAN_NATIVE_LANES == 16
  if constexpr (kIsNative) return _mm512_min_ps(a, b);
#elif TURNSCAN_NATIVE_LANES == 8
  if constexpr (kIsNative) return _mm256_min_ps(a, b);
#endif
  return a < b ? a : b;
}
/// a > b ? a : b.
template <class V>
inline V larger(const V& a, const V& b) {
#if TURNSCAN_NATIVE_LANES == 16
  if constexpr (kIsNative) return _mm512_max_ps(a, b);
#elif TURNSCAN_NATIVE_LANES == 8
  if constexpr (kIsNative) return _mm256_max_ps(a, b);
#endif
  return a > b ? a : b;
}

/// from[at], lane by lane.
template <class V>
inline V gather(const std::uint32_t* from, const V& at) {
#if TURNSCAN_NATIVE_LANES == 16
  if constexpr (kIsNative)
    return reinterpret_cast<V>(_mm512_i32gather_epi32(reinterpret_cast<__m512i>(at), from, 4));
#elif TURNSCAN_NATIVE_LANES == 8
  if constexpr (kIsNative)
    return reinterpret_cast<V>(_mm256_i32gather_epi32(reinterpret_cast<const int*>(from),
                                                      reinterpret_cast<__m256i>(at), 4));
#endif
  V out;
  for (int k = 0; k < int(kLanes); ++k) out[k] = static_cast<int>(from[at[k]]);
  return out;
}

/// One bit a lane of a mask.
inline unsigned bits(const I& mask) {
  unsigned out = 0;
#if TURNSCAN_NATIVE_LANES == 16
  out = _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask));
#elif defined(__SSE2__)
  NativeF part[kLanes / kNative];
  __builtin_memcpy(part, &mask, sizeof part);
  for (int k = 0; k < int(kLanes) / kNative; ++k) {
#if TURNSCAN_NATIVE_LANES == 8
    out |= static_cast<unsigned>(_mm256_movemask_ps(part[k])) << kNative * k;
#else
    out |= static_cast<unsigned>(_mm_movemask_ps(part[k])) << kNative * k;
#endif
  }
#elif defined(__ARM_NEON)
  const I marked = mask & (1 << counting());
  uint32x4_t part[kLanes / kNative];
  __builtin_memcpy(part, &marked, sizeof part);
  for (int k = 0; k < int(kLanes) / kNative; ++k) out |= vaddvq_u32(part[k]);
#else
  for (int k = 0; k < int(kLanes); ++k) out |= (mask[k] != 0 ? 1u : 0u) << k;
#endif
  return out;
}
