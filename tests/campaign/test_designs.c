/* The sampling designs against closed forms of the site's law, and the laws that intervals rely on: pure functions of the id, weights that average
 * to 1, shares of strata, independent randomisations. */
#include "campaign/designs.h"

static bool is_same(const fw_scenario *a, const fw_scenario *b)
{
    return a->seed == b->seed && a->id == b->id && a->concentration == b->concentration && a->speed == b->speed && a->mix == b->mix && a->cell == b->cell &&
           a->wind_speed == b->wind_speed && a->wind_angle == b->wind_angle && a->tide_phase == b->tide_phase && a->weight == b->weight &&
           a->randomisation == b->randomisation;
}

/* Any order, far ids in between; seed and id both matter. */
static void pure_functions_of_the_id(void **state)
{
    enum { FEW = 200 };
    (void)state;
    for (int way = 0; way < N_WAYS; way++) {
        fw_campaign c = designs_campaign(7, way, 17), d = designs_campaign(8, way, 17);
        fw_scenario first[FEW], far[FEW], again;
        designs_add_weather(&c);
        designs_add_weather(&d);
        for (uint64_t i = 0; i < FEW; i++) fw_campaign_scenario(&c, i, &first[i]);
        for (uint64_t i = 0; i < FEW; i++) fw_campaign_scenario(&c, (UINT64_C(1) << 40) - 7 * i, &far[i]);
        for (uint64_t i = FEW; i-- > 0;) {
            fw_campaign_scenario(&c, (UINT64_C(1) << 40) - 7 * i, &again);
            assert_true(is_same(&again, &far[i]));
            fw_campaign_scenario(&c, i, &again);
            assert_true(is_same(&again, &first[i]));
            assert_true(again.id == i && again.seed == 7 && again.weight > 0 && again.cell == 0);
            assert_int_equal(again.randomisation, way ? (int32_t)(i % 17) : -1);
            assert_true(far[i].speed != first[i].speed && far[i].wind_angle != first[i].wind_angle);
            fw_campaign_scenario(&d, i, &again);
            assert_true(again.speed != first[i].speed && again.tide_phase != first[i].tide_phase);
            if (i > 0) assert_true(first[i].speed != first[i - 1].speed);
        }
        fw_campaign_free(&c);
        fw_campaign_free(&d);
    }
}

/* Plain scenarios are the same ones, whatever the design. */
static void plain_scenarios_of_any_design(void **state)
{
    fw_campaign c = designs_campaign(7, 0, 0);
    (void)state;
    for (int way = 1; way < N_WAYS; way++) {
        fw_campaign d = designs_campaign(7, way, 16);
        fw_scenario a, b;
        for (uint64_t i = 0; i < 50; i++) {
            fw_campaign_scenario(&c, i, &a);
            fw_campaign_plain_scenario(&d, i, &b);
            assert_true(is_same(&a, &b));
        }
        fw_campaign_free(&d);
    }
    fw_campaign_free(&c);
}

/* ---- means ------------------------------------------------------------------------------------------------------- */

enum { N_MEANS = 10, N_IDS = 32 * 1000 };

/* Functions of a scenario with their means over the law: of x uniform on [a, b], E x^k = (b^(k+1) - a^(k+1)) / ((k + 1)(b - a)). */
static void functions(const fw_scenario *s, double *f)
{
    double u = s->speed, c = s->concentration, heavy = s->mix == 1, pi = acos(-1);
    f[0] = u, f[1] = u * u * u, f[2] = c, f[3] = heavy, f[4] = u * u * u * c * heavy, f[5] = u > 1.4 && c > 0.5;
    f[6] = s->wind_speed / 20, f[7] = s->wind_angle / pi, f[8] = s->tide_phase / pi, f[9] = f[6] * f[7] * u;
}
static const double MEANS[N_MEANS] = {1, 1.25, 0.4, 0.75, 1.25 * 0.4 * 0.75, 0.1 * 0.25, 0.5, -0.25, 1, -0.5 * 0.25};

/* Weighted means within five standard errors of independent draws with these weights, which no design exceeds by much and most stay far below. */
static void means_are_those_of_the_law(void **state)
{
    (void)state;
    for (int way = 0; way < N_WAYS; way++) {
        fw_campaign c = designs_campaign(11, way, 32);
        double      weight = 0, weight_2 = 0, sum[N_MEANS] = {0}, squares[N_MEANS] = {0}, f[N_MEANS], n = N_IDS;
        fw_scenario s;
        designs_add_weather(&c);
        for (uint64_t i = 0; i < N_IDS; i++) {
            fw_campaign_scenario(&c, i, &s);
            assert_true(s.speed > 0.5 && s.speed < 1.5 && s.concentration > 0.2 && s.concentration < 0.6 && s.mix < 2);
            functions(&s, f);
            for (size_t k = 0; k < N_MEANS; k++) sum[k] += s.weight * (f[k] - MEANS[k]), squares[k] += pow(s.weight * (f[k] - MEANS[k]), 2);
            weight += s.weight - 1, weight_2 += (s.weight - 1) * (s.weight - 1);
        }
        for (size_t k = 0; k < N_MEANS; k++)
            if (!(fabs(sum[k]) < 5 * sqrt(squares[k]))) fail_msg("%s: function %zu is off by %g of %g", WAYS[way], k, sum[k] / n, sqrt(squares[k]) / n);
        CHECK_NEAR(weight / n, 0, 5 * sqrt(weight_2) / n + 1e-12);
        if (way != 2) assert_true(weight_2 < 1e-20 * n);
        fw_campaign_free(&c);
    }
}

/* ---- strata ------------------------------------------------------------------------------------------------------ */

/* Of every stratum a randomisation takes its share of the points to within two where their number is a power of 2, and its weight is share of time over
 * share of realisations. */
static void strata_have_their_share(void **state)
{
    (void)state;
    for (int way = 1; way <= 2; way++) {
        fw_campaign c = designs_campaign(3, way, 16);
        fw_strata   s;
        fw_scenario sc;
        fw_strata_make(&s, &c.model, &c.site);
        assert_int_equal(s.n, 8 * 4 * 2);
        for (uint64_t r = 0; r < 16; r++) {
            double count[64] = {0};
            for (uint64_t k = 0; k < 4096; k++) {
                fw_campaign_scenario(&c, 16 * k + r, &sc);
                size_t at = fw_strata_find(&s, &sc);
                double share = fw_strata_share(&s, at), q = c.sampling.n_allocation ? c.sampling.allocation[at] : share;
                CHECK_RELATIVE(sc.weight, share / q, 1e-12);
                count[at] += 1;
                bool is_power = ((k + 1) & k) == 0;
                for (size_t i = 0; i < s.n && (is_power || k % 512 == 300); i++) {
                    double wanted = c.sampling.n_allocation ? c.sampling.allocation[i] : fw_strata_share(&s, i);
                    CHECK_NEAR(count[i], wanted * (double)(k + 1), is_power ? 2 : 4);
                }
            }
        }
        fw_campaign_free(&c);
    }
}

/* A joint table: cells in their share, all their values together, the impossible one never; weights as above. */
static void joint_tables(void **state)
{
    enum { N = 16 * 1024 };
    (void)state;
    for (int way = 0; way < N_WAYS; way++) {
        fw_campaign c = designs_joint_campaign(5, way);
        double      count[4] = {0}, weighted[4] = {0};
        fw_scenario s;
        for (uint64_t i = 0; i < N; i++) {
            fw_campaign_scenario(&c, i, &s);
            assert_in_range(s.cell, 0, 3);
            assert_true(s.speed == CELL_SPEED[s.cell] && s.concentration == 0.1 * (s.cell + 1) && s.mix == s.cell % 2);
            assert_true(fw_site_direction(&c.site, &s) == &c.site.cells[s.cell].direction);
            CHECK_RELATIVE(s.weight, c.sampling.n_allocation ? CELL_SHARE[s.cell] / c.sampling.allocation[s.cell] : 1, 1e-12);
            count[s.cell] += 1, weighted[s.cell] += s.weight;
        }
        for (int i = 0; i < 4; i++) {
            double p = CELL_SHARE[i], q = c.sampling.n_allocation ? c.sampling.allocation[i] : p;
            CHECK_NEAR(count[i] / N, q, 5 * sqrt(q * (1 - q) / N));
            CHECK_NEAR(weighted[i] / N, p, 5 * (q > 0 ? p / q : 0) * sqrt(q * (1 - q) / N));
            if (way) CHECK_NEAR(count[i], q * N, 16 * 2); /* each randomisation of a design to within two */
        }
        fw_campaign_free(&c);
    }
}

/* ---- variance ---------------------------------------------------------------------------------------------------- */

static double depth_like(const fw_scenario *s) { return pow(s->speed, 3) * pow(s->concentration, 1.5) * (1 + 0.2 * s->mix); }

/* E and variance of depth_like, closed forms: uniform laws and a coin of 1 : 3. */
static void moments_of_depth_like(double *mean, double *variance)
{
    double u3 = 1.25, u6 = (pow(1.5, 7) - pow(0.5, 7)) / 7, c15 = (pow(0.6, 2.5) - pow(0.2, 2.5)) / 2.5 / 0.4, c3 = (pow(0.6, 4) - pow(0.2, 4)) / 4 / 0.4;
    *mean = u3 * c15 * (0.25 + 0.75 * 1.2);
    *variance = u6 * c3 * (0.25 + 0.75 * 1.44) - *mean * *mean;
}

/* Means over `points` of depth_like in every randomisation. */
static void means_of_randomisations(const fw_campaign *c, uint64_t n, uint64_t points, double *means)
{
    fw_scenario s;
    for (uint64_t r = 0; r < n; r++) {
        double weight = 0;
        means[r] = 0;
        for (uint64_t k = 0; k < points; k++) {
            fw_campaign_scenario(c, k * n + r, &s);
            means[r] += s.weight * depth_like(&s), weight += s.weight;
        }
        means[r] /= weight;
    }
}

/* Variance of a mean of 64 over that of 64 plain draws. The stratified one leaves what is inside the strata, Latin what is no sum over the coordinates. */
static void smooth_functions_scatter_less(void **state)
{
    enum { N = 256, POINTS = 64 };
    static const double most[N_WAYS] = {1.5, 0.15, 0.15, 0.2, 0.005, 0.03};
    double              mean, variance, means[N];
    (void)state;
    moments_of_depth_like(&mean, &variance);
    for (int way = 1; way < N_WAYS; way++) {
        fw_campaign c = designs_campaign(21, way, N);
        double      squares = 0;
        means_of_randomisations(&c, N, POINTS, means);
        for (size_t r = 0; r < N; r++) squares += pow(means[r] - mean, 2) / N;
        double ratio = squares / (variance / POINTS);
        if (!(ratio < most[way])) fail_msg("%s: %.4f of plain sampling's variance", WAYS[way], ratio);
        fw_campaign_free(&c);
    }
}

/* What intervals are made from: the squared error of the mean over 16 randomisations is on average that which their scatter says, within five standard
 * errors of a chi-square's. Randomisations that knew of each other would not. */
static void randomisations_are_independent(void **state)
{
    enum { N = 16, SEEDS = 400 };
    double mean, variance, means[N];
    (void)state;
    moments_of_depth_like(&mean, &variance);
    for (int way = 1; way < N_WAYS; way++) {
        double error = 0, said = 0;
        for (uint64_t seed = 1; seed <= SEEDS; seed++) {
            fw_campaign c = designs_campaign(seed, way, N);
            double      all = 0, squares = 0;
            means_of_randomisations(&c, N, 16, means);
            for (size_t r = 0; r < N; r++) all += means[r] / N;
            for (size_t r = 0; r < N; r++) squares += pow(means[r] - all, 2);
            error += pow(all - mean, 2) / SEEDS, said += squares / (N - 1) / N / SEEDS;
            fw_campaign_free(&c);
        }
        CHECK_NEAR(error / said, 1, 5 * sqrt(2.0 / SEEDS));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pure_functions_of_the_id),      cmocka_unit_test(plain_scenarios_of_any_design), cmocka_unit_test(means_are_those_of_the_law),
        cmocka_unit_test(strata_have_their_share),       cmocka_unit_test(joint_tables),                  cmocka_unit_test(smooth_functions_scatter_less),
        cmocka_unit_test(randomisations_are_independent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
