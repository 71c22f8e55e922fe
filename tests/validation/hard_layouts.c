/* Many floes from a few numbers. */
#include <math.h>

#include "base/random.h"
#include "validation/hard_scenes.h"

static const double PI = 3.14159265358979323846, PAPER_RADIUS = 3.7;

static void put(fw_floe *to, size_t capacity, size_t *n, fw_floe f)
{
    if (*n < capacity) to[*n] = f;
    ++*n;
}

size_t hard_hexagon(fw_floe *to, size_t capacity, const double *p)
{
    int    rings = (int)p[0];
    size_t n = 0;
    double pitch = p[1] + p[4], middle = p[3] - 0.5 * p[1] - rings * pitch;
    for (int q = -rings; q <= rings; q++)
        for (int r = -rings; r <= rings; r++) {
            if (q + r < -rings || q + r > rings) continue;
            put(to, capacity, &n, (fw_floe){.x = middle + pitch * (q + 0.5 * r), .y = pitch * sqrt(0.75) * r + p[6], .diameter = p[1], .thickness = p[2], .vx = p[5]});
        }
    return n;
}

size_t hard_square(fw_floe *to, size_t capacity, const double *p)
{
    int    columns = (int)p[0], rows = (int)p[1];
    size_t n = 0;
    double pitch = p[2] + p[4];
    for (int c = 0; c < columns; c++)
        for (int r = 0; r < rows; r++)
            put(to, capacity, &n, (fw_floe){.x = -PAPER_RADIUS - 0.5 * p[2] - p[4] - pitch * c, .y = pitch * (r - 0.5 * (rows - 1)), .diameter = p[2], .thickness = p[3], .vx = p[5]});
    return n;
}

size_t hard_line(fw_floe *to, size_t capacity, const double *p)
{
    size_t n = 0;
    for (int i = 0; i < (int)p[0]; i++)
        put(to, capacity, &n, (fw_floe){.x = p[3] - 0.5 * p[1] - i * (p[1] + p[4]), .diameter = p[1], .thickness = p[2], .vx = p[5]});
    return n;
}

size_t hard_row_of(fw_floe *to, size_t capacity, const double *p)
{
    size_t n = 0;
    double reach = p[3] + 0.5 * p[1] + 0.1;
    for (int i = 0; i < (int)p[0]; i++) {
        double y = (i - 0.5 * (p[0] - 1)) * (p[1] + p[4]);
        put(to, capacity, &n, (fw_floe){.x = -sqrt(reach * reach - y * y), .y = y, .diameter = p[1], .thickness = p[2], .vx = p[5]});
    }
    return n;
}

size_t hard_ring(fw_floe *to, size_t capacity, const double *p)
{
    size_t n = 0;
    double reach = p[4] + 0.5 * p[1];
    for (int i = 0; i < (int)p[0]; i++) {
        double a = 2 * PI * (i + 0.5) / p[0];
        put(to, capacity, &n, (fw_floe){.x = reach * cos(a), .y = reach * sin(a), .diameter = p[1], .thickness = p[2], .vx = -p[3] * cos(a), .vy = -p[3] * sin(a)});
    }
    return n;
}

size_t hard_crowd(fw_floe *to, size_t capacity, const double *p)
{
    size_t      n = 0, side = (size_t)ceil(sqrt(p[0]));
    double      pitch = p[1] + p[3];
    fw_uniforms u;
    fw_uniforms_stream(&u, 20260101, FW_STREAM_TEST, 2, (uint64_t)p[5]);
    for (size_t i = 0; i < (size_t)p[0]; i++) {
        double speed = p[4] * fw_uniforms_next(&u), way = 2 * PI * fw_uniforms_next(&u), spin = p[4] * (fw_uniforms_next(&u) - 0.5);
        put(to, capacity, &n, (fw_floe){.x = -1000 + pitch * (double)(i % side), .y = pitch * (double)(i / side), .diameter = p[1], .thickness = p[2],
                                        .vx = speed * cos(way), .vy = speed * sin(way), .spin = spin});
    }
    return n;
}

size_t hard_mixed(fw_floe *to, size_t capacity, const double *p)
{
    size_t      n = 0;
    double      pitch = p[2] + p[3];
    fw_uniforms u;
    fw_uniforms_stream(&u, 20260101, FW_STREAM_TEST, 3, (uint64_t)p[5]);
    for (int c = 0; c < (int)p[0]; c++)
        for (int r = 0; r < (int)p[1]; r++) {
            /* thickness in proportion to diameter: mass as its cube */
            double d = p[2] * pow(0.01, fw_uniforms_next(&u) / 3);
            put(to, capacity, &n, (fw_floe){.x = -PAPER_RADIUS - 0.5 * p[2] - p[3] - pitch * c, .y = pitch * (r - 0.5 * (p[1] - 1)) + 0.2, .diameter = d, .thickness = d / 5, .vx = p[4]});
        }
    return n;
}

size_t hard_flower(fw_floe *to, size_t capacity, const double *p)
{
    size_t n = 0;
    double reach = 0.5 * (p[0] + p[1]) + p[3];
    put(to, capacity, &n, (fw_floe){.x = p[5], .diameter = p[0], .thickness = p[2]});
    for (int i = 0; i < 6; i++) {
        double a = PI / 3 * i + 0.1;
        put(to, capacity, &n, (fw_floe){.x = p[5] + reach * cos(a), .y = reach * sin(a), .diameter = p[1], .thickness = p[2], .vx = -p[4] * cos(a), .vy = -p[4] * sin(a)});
    }
    return n;
}
