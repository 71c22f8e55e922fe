#include "kernel/method.h"

/* 2 - sqrt 2, its half, and sqrt 2 / 4 */
#define G2 0.58578643762690495
#define D2 0.29289321881345248
#define W2 0.35355339059327376

static const fw_method TRBDF2 = {
    .name = "trbdf2",
    .source = "Bank et al. 1985; as ESDIRK with embedded third order: Hosea and Shampine 1996",
    .n_stages = 3,
    .order = 2,
    .error_order = 3,
    .gamma = D2,
    .a = {{0}, {D2, D2}, {W2, W2, D2}},
    .c = {0, G2, 1},
    .b = {W2, W2, D2},
    .e = {W2 - (1 - W2) / 3, W2 - (3 * W2 + 1) / 3, D2 - D2 / 3},
};

#define G3  (1767732205903.0 / 4055673282236.0)
#define B30 (1471266399579.0 / 7840856788654.0)
#define B31 (-4482444167858.0 / 7529755066697.0)
#define B32 (11266239266428.0 / 11593286722821.0)
static const fw_method ARK3 = {
    .name = "ark3",
    .source = "Kennedy and Carpenter 2003, ARK3(2)4L[2]SA, implicit part",
    .n_stages = 4,
    .order = 3,
    .error_order = 3,
    .gamma = G3,
    .a = {{0},
          {G3, G3},
          {2746238789719.0 / 10658868560708.0, -640167445237.0 / 6845629431997.0, G3},
          {B30, B31, B32, G3}},
    .c = {0, 2 * G3, 0.6, 1},
    .b = {B30, B31, B32, G3},
    .e = {B30 - 2756255671327.0 / 12835298489170.0, B31 + 10771552573575.0 / 22201958757719.0,
          B32 - 9247589265047.0 / 10645013368117.0, G3 - 2193209047091.0 / 5459859503100.0},
};

#define B40 (82889.0 / 524892.0)
#define B42 (15625.0 / 83664.0)
#define B43 (69875.0 / 102672.0)
#define B44 (-2260.0 / 8211.0)
static const fw_method ARK4 = {
    .name = "ark4",
    .source = "Kennedy and Carpenter 2003, ARK4(3)6L[2]SA, implicit part",
    .n_stages = 6,
    .order = 4,
    .error_order = 4,
    .gamma = 0.25,
    .a = {{0},
          {0.25, 0.25},
          {8611.0 / 62500.0, -1743.0 / 31250.0, 0.25},
          {5012029.0 / 34652500.0, -654441.0 / 2922500.0, 174375.0 / 388108.0, 0.25},
          {15267082809.0 / 155376265600.0, -71443401.0 / 120774400.0, 730878875.0 / 902184768.0, 2285395.0 / 8070912.0,
           0.25},
          {B40, 0, B42, B43, B44, 0.25}},
    .c = {0, 0.5, 83.0 / 250.0, 31.0 / 50.0, 17.0 / 20.0, 1},
    .b = {B40, 0, B42, B43, B44, 0.25},
    .e = {B40 - 4586570599.0 / 29645900160.0, 0, B42 - 178811875.0 / 945068544.0, B43 - 814220225.0 / 1159782912.0,
          B44 + 3700637.0 / 11593932.0, 0.25 - 61727.0 / 225920.0},
};

const fw_method *const FW_METHOD_TRBDF2 = &TRBDF2;
const fw_method *const FW_METHOD_ARK3 = &ARK3;
const fw_method *const FW_METHOD_ARK4 = &ARK4;
