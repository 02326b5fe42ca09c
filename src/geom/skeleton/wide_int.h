// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// WideInt: signed integers of up to 640 bits on the stack, for exact signs of the determinants in
// planes.h. The widest product there has 490 bits. An overflow throws, as everything does that a
// library refuses (base/work.h); it never gives a wrong sign.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace gable::skeleton {

__extension__ using Int128 = __int128;

constexpr unsigned kWideBits = 640;
using WideInt =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
                                      kWideBits, kWideBits, boost::multiprecision::signed_magnitude,
                                      boost::multiprecision::checked, void>,
                                  boost::multiprecision::et_off>;

/// num / den as the nearest double, or one beside it.
double quotient(const WideInt& num, const WideInt& den);

/// The largest whole number whose square is at most `square`, which is not negative and has at most
/// 210 bits.
WideInt rootOf(const WideInt& square);

}  // namespace gable::skeleton
