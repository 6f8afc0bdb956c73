/* SPDX-License-Identifier: MIT
 * forms.c: the closed forms. */
#include "forms.h"

#include <math.h>

static form_vec add_scaled(form_vec a, form_vec b, long double s)
{
    return (form_vec){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}

static long double dot(form_vec a, form_vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

form_vec form_along_plane(form_vec u, form_vec n)
{
    return add_scaled(u, n, -fminl(0, dot(n, u)));
}

form_vec form_along_crease(form_vec u, form_vec n1, form_vec n2)
{
    form_vec c = {n1.y * n2.z - n1.z * n2.y, n1.z * n2.x - n1.x * n2.z, n1.x * n2.y - n1.y * n2.x};
    long double part = dot(u, c) / dot(c, c);
    return (form_vec){c.x * part, c.y * part, c.z * part};
}

long double form_step_contact(long double r, long double h)
{
    return -sqrtl(h * (2 * r - h));
}

long double form_step_height(long double r, long double h, long double x)
{
    if (x >= 0) {
        return h + r;
    }
    return x <= form_step_contact(r, h) ? r : h + sqrtl((r - x) * (r + x));
}

long double form_highest_slope_step(long double r, long double angle)
{
    long double s = sinl(angle / 2);
    return 2 * r * s * s;
}

long double form_overhang(long double r, long double angle)
{
    return r * sinl(angle);
}

long double form_round_angle(long double angle, long double u, long double radius, long double time)
{
    return 2 * atanl(tanl(angle / 2) * expl(u * time / radius));
}

form_motion form_thrown(long double v, long double g, long double time)
{
    return (form_motion){v * time - g * time * time / 2, v - g * time};
}

long double form_apex_time(long double v, long double g)
{
    return v / g;
}

long double form_apex_height(long double v, long double g)
{
    return v * v / (2 * g);
}

long double form_landing_time(long double v, long double g, long double h)
{
    return (v + sqrtl(v * v - 2 * g * h)) / g;
}

form_motion form_drag(long double v, long double a, long double k, long double time)
{
    long double end = a / k, gone = -expm1l(-k * time); /* 1 - e^-kt */
    return (form_motion){end * time + (v - end) * gone / k, v + (end - v) * gone};
}

long double form_brake_time(long double v, long double b, long double k)
{
    if (k == 0) {
        return v / b;
    }
    return b > 0 ? log1pl(k * v / b) / k : INFINITY;
}

long double form_brake_way(long double v, long double b, long double k)
{
    if (k == 0) {
        return v * v / (2 * b);
    }
    return b > 0 ? v / k - b / (k * k) * log1pl(k * v / b) : v / k;
}

form_motion form_brake(long double v, long double b, long double k, long double time)
{
    if (time >= form_brake_time(v, b, k)) {
        return (form_motion){form_brake_way(v, b, k), 0};
    }
    return k == 0 ? (form_motion){v * time - b * time * time / 2, v - b * time} : form_drag(v, -b, k, time);
}

form_motion form_capped(long double v, long double a, long double cap, long double time)
{
    long double until = (cap - v) / a;
    if (time <= until) {
        return (form_motion){v * time + a * time * time / 2, v + a * time};
    }
    return (form_motion){v * until + a * until * until / 2 + cap * (time - until), cap};
}

form_vec form_turntable(form_vec start, long double w, long double time)
{
    long double c = cosl(w * time), s = sinl(w * time);
    return (form_vec){start.x * c - start.y * s, start.x * s + start.y * c, start.z};
}
