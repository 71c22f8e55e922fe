/* What every cmocka test here includes, and two checks for floating point. */
#ifndef FW_TESTS_CHECK_H
#define FW_TESTS_CHECK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

/* |got - want| <= tolerance, absolute; NaN fails. */
#define CHECK_NEAR(got, want, tolerance)                                                                               \
    do {                                                                                                               \
        double got_ = (got), want_ = (want), tol_ = (tolerance);                                                       \
        if (!(fabs(got_ - want_) <= tol_)) {                                                                           \
            print_error("%s = %.17g, wanted %.17g +- %g\n", #got, got_, want_, tol_);                                  \
            fail();                                                                                                    \
        }                                                                                                              \
    } while (0)

/* |got / want - 1| <= tolerance. */
#define CHECK_RELATIVE(got, want, tolerance)                                                                           \
    do {                                                                                                               \
        double got_ = (got), want_ = (want), tol_ = (tolerance);                                                       \
        if (!(fabs(got_ - want_) <= tol_ * fabs(want_))) {                                                             \
            print_error("%s = %.17g, wanted %.17g (relative %.3g, allowed %g)\n", #got, got_, want_, got_ / want_ - 1, \
                        tol_);                                                                                         \
            fail();                                                                                                    \
        }                                                                                                              \
    } while (0)

#endif
