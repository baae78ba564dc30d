/* The polynomials; see kingery_curves.h.
 *
 *   y = 10^(sum of c_i U^i),   U = a + b log10(Z)
 *
 * Numbers: kb_equation_data.csv of github.com/lightsquared/kingery_bulmash, in which the free-air
 * incident pressure (c_5), incident impulse (b) and reflected pressure (c_2, c_5) are damaged;
 * they are repaired here with the tables of TM 5-1300 in OpenRadioss, pblast_mod.F90. The result
 * follows those tables within 0.01 % (incident pressure) to 0.8 % (reflected). */
#include "exact/kingery_curves.h"

#include "base/exponential.h"

enum { TERMS = 15 };

struct curve {
    enum kingery_charge charge;
    enum kingery_quantity quantity;
    double nearest, farthest, a, b;
    int terms;
    double c[TERMS];
};

static const struct curve curves[] = {
    {KINGERY_FREE_AIR,
     KINGERY_PRESSURE,
     0.0531,
     40,
     -0.214362789,
     1.3503425,
     9,
     {2.611368669, -1.690128014, 0.008049736, 0.336743115, -0.005162264, -0.0809228619888,
      -0.004785073, 0.007930305, 0.0007684469735}},
    {KINGERY_FREE_AIR,
     KINGERY_REFLECTED_PRESSURE,
     0.0531,
     40,
     -0.214362789,
     1.3503425,
     10,
     {3.229580314, -2.21400539, 0.035119031446, 0.657999921, 0.014181895, -0.243076636231,
      -0.01586998, 0.049274118, 0.002276396, -0.003971263}},
    {KINGERY_FREE_AIR,
     KINGERY_IMPULSE,
     0.0531,
     0.792,
     2.347239214,
     3.24299066475,
     5,
     {2.388305168, -0.443749378, 0.168825415, 0.034813803, -0.010435193}},
    {KINGERY_FREE_AIR,
     KINGERY_IMPULSE,
     0.792,
     40,
     -1.753056603,
     2.306292318,
     9,
     {1.551972271, -0.404632921, -0.014272195, 0.009123663, -0.000675068, -0.008008637, 0.003148195,
      0.001520448, -0.000747027}},
    {KINGERY_FREE_AIR,
     KINGERY_REFLECTED_IMPULSE,
     0.0531,
     40,
     -0.204004455,
     1.37882996,
     4,
     {2.55875566, -0.903118886, 0.101771878, -0.024213975}},
    {KINGERY_FREE_AIR,
     KINGERY_ARRIVAL,
     0.0531,
     40,
     -0.253273112,
     1.374070438,
     8,
     {0.072070779, 1.364568712, -0.057003569, -0.182832225, 0.011885144, 0.043264869, -0.000799737,
      -0.004360736}},
    {KINGERY_FREE_AIR,
     KINGERY_DURATION,
     0.147,
     0.888,
     2.263672685,
     5.115885543,
     9,
     {-0.68660855, 0.164953518, 0.127788499, 0.002914301, 0.001879574, 0.017341396, 0.002697398,
      -0.003619765, -0.001009266}},
    {KINGERY_FREE_AIR,
     KINGERY_DURATION,
     0.888,
     2.28,
     -1.333612067,
     9.299628861,
     9,
     {0.230318411, -0.029794427, 0.030632954, 0.018340557, -0.017396467, -0.00106322, 0.0056206,
      0.000161822, -0.000686019}},
    {KINGERY_FREE_AIR,
     KINGERY_DURATION,
     2.28,
     40,
     -3.130058053,
     3.152472536,
     8,
     {0.621036276, 0.0967032, -0.008013021, 0.004827058, 0.001875873, -0.002467385, -0.000841117,
      0.000619329}},
    {KINGERY_FREE_AIR,
     KINGERY_SPEED,
     0.0531,
     40,
     -0.214362789,
     1.3503425,
     14,
     {-0.144615443, -0.65050756, 0.291320654, 0.307916323, -0.183361123, -0.197740455, 0.090911956,
      0.089892618, -0.028737099, -0.024873022, 0.004963117, 0.003722421, -0.000353374,
      -0.000229291}},
    {KINGERY_SURFACE,
     KINGERY_PRESSURE,
     0.0674,
     40,
     -0.214362789151,
     1.35034249993,
     12,
     {2.78076916577, -1.6958988741, -0.154159376846, 0.514060730593, 0.0988534365274,
      -0.293912623038, -0.0268112345019, 0.109097496421, 0.00162846756311, -0.0214631030242,
      0.0001456723382, 0.00167847752277}},
    {KINGERY_SURFACE,
     KINGERY_REFLECTED_PRESSURE,
     0.0674,
     40,
     -0.240657322658,
     1.36637719229,
     12,
     {3.40283217581, -2.21030870597, -0.218536586295, 0.895319589372, 0.24989009775,
      -0.569249436807, -0.11791682383, 0.224131161411, 0.0245620259375, -0.0455116002694,
      -0.00190930738887, 0.00361471193389}},
    {KINGERY_SURFACE,
     KINGERY_IMPULSE,
     0.0674,
     0.955,
     2.06761908721,
     3.0760329666,
     5,
     {2.52455620925, -0.502992763686, 0.171335645235, 0.0450176963051, -0.0118964626402}},
    {KINGERY_SURFACE,
     KINGERY_IMPULSE,
     0.955,
     40,
     -1.94708846747,
     2.40697745406,
     8,
     {1.67231644586, -0.384519026965, -0.0260816706301, 0.00595798753822, 0.014544526107,
      -0.00663289334734, -0.00284189327204, 0.0013644816227}},
    {KINGERY_SURFACE,
     KINGERY_REFLECTED_IMPULSE,
     0.0674,
     40,
     -0.246208804814,
     1.33422049854,
     4,
     {2.70588058103, -0.949516092853, 0.112136118689, -0.0250659183287}},
    {KINGERY_SURFACE,
     KINGERY_ARRIVAL,
     0.0674,
     40,
     -0.202425716178,
     1.37784223635,
     10,
     {-0.0591634288046, 1.35706496258, 0.052492798645, -0.196563954086, -0.0601770052288,
      0.0696360270891, 0.0215297490092, -0.0161658930785, -0.00232531970294, 0.00147752067524}},
    {KINGERY_SURFACE,
     KINGERY_DURATION,
     0.178,
     1.01,
     1.92946154068,
     5.25099193925,
     6,
     {-0.614227603559, 0.130143717675, 0.134872511954, 0.0391574276906, -0.00475933664702,
      -0.00428144598008}},
    {KINGERY_SURFACE,
     KINGERY_DURATION,
     1.01,
     2.78,
     -2.12492525216,
     9.2996288611,
     9,
     {0.315409245784, -0.0297944268976, 0.030632954288, 0.0183405574086, -0.0173964666211,
      -0.00106321963633, 0.00562060030977, 0.0001618217499, -0.0006860188944}},
    {KINGERY_SURFACE,
     KINGERY_DURATION,
     2.78,
     40,
     -3.53626218091,
     3.46349745571,
     6,
     {0.686906642409, 0.0933035304009, -0.0005849420883, -0.00226884995013, -0.00295908591505,
      0.00148029868929}},
    {KINGERY_SURFACE,
     KINGERY_SPEED,
     0.0674,
     40,
     -0.202425716178,
     1.37784223635,
     15,
     {-0.06621072854, -0.698029762594, 0.158916781906, 0.443812098136, -0.113402023921,
      -0.369887075049, 0.129230567449, 0.19857981197, -0.0867636217397, -0.0620391900135,
      0.0307482926566, 0.0102655723441, -0.00546533250772, -0.000693180974, 0.0003847494916}},
};

double kingery_curve(enum kingery_charge charge, enum kingery_quantity quantity, double z)
{
    for (size_t k = 0; k < COUNT_OF(curves); k++) {
        const struct curve *curve = &curves[k];
        if (curve->charge != charge || curve->quantity != quantity ||
            !(z >= curve->nearest && z <= curve->farthest))
            continue;
        const double u = curve->a + curve->b * logarithm(z) / M_LN10;
        double sum = 0.0;
        for (int i = curve->terms - 1; i >= 0; i--)
            sum = sum * u + curve->c[i];
        return exponential(sum * M_LN10);
    }
    return NAN;
}

double kingery_nearest(enum kingery_charge charge)
{
    return charge == KINGERY_FREE_AIR ? 0.0531 : 0.0674;
}

double kingery_farthest(enum kingery_charge charge)
{
    (void)charge;
    return 40.0;
}

struct blast_wave kingery_wave(enum kingery_charge charge, double mass, double distance,
                               bool reflected)
{
    const double size = cube_root(mass), z = distance / size;
    return (struct blast_wave){
        .arrival = 1e-3 * size * kingery_curve(charge, KINGERY_ARRIVAL, z),
        .overpressure =
            1e3 *
            kingery_curve(charge, reflected ? KINGERY_REFLECTED_PRESSURE : KINGERY_PRESSURE, z),
        .duration = 1e-3 * size * kingery_curve(charge, KINGERY_DURATION, z),
        .impulse = size * kingery_curve(charge,
                                        reflected ? KINGERY_REFLECTED_IMPULSE : KINGERY_IMPULSE, z),
    };
}

/* DISTANCE within the range of the curves. */
static double in_range(enum kingery_charge charge, double mass, double distance)
{
    const double size = cube_root(mass), low = kingery_nearest(charge) * size * (1.0 + 1e-12),
                 high = kingery_farthest(charge) * size * (1.0 - 1e-12);
    return minimum(maximum(distance, low), high);
}

/* By the incident and the reflected wave. */
static double load_of(const struct blast_wave *incident, const struct blast_wave *reflected,
                      double cosine, double time)
{
    return blast_wave_at(incident, time) * (1.0 + square(cosine) - 2.0 * cosine) +
           blast_wave_at(reflected, time) * square(cosine);
}

double kingery_load(enum kingery_charge charge, double mass, double distance, double cosine,
                    double time)
{
    const double at = in_range(charge, mass, distance), size = cube_root(mass);
    if (!(cosine > 0.0) || time < 1e-3 * size * kingery_curve(charge, KINGERY_ARRIVAL, at / size))
        return 0.0;
    const struct blast_wave incident = kingery_wave(charge, mass, at, false),
                            reflected = kingery_wave(charge, mass, at, true);
    return load_of(&incident, &reflected, cosine, time);
}

double kingery_load_impulse(enum kingery_charge charge, double mass, double distance, double cosine,
                            double from, double to)
{
    const double at = in_range(charge, mass, distance), size = cube_root(mass);
    const double arrival = 1e-3 * size * kingery_curve(charge, KINGERY_ARRIVAL, at / size);
    if (!(cosine > 0.0) || to <= arrival)
        return 0.0;
    const struct blast_wave incident = kingery_wave(charge, mass, at, false),
                            reflected = kingery_wave(charge, mass, at, true);
    const double end = arrival + incident.duration; /* not a number: there is none */
    const double begin = maximum(from, arrival), until = to > end ? end : to;
    const double middle = 0.5 * (begin + until), half = 0.5 * (until - begin);
    if (!(half > 0.0))
        return 0.0;
    return half * (load_of(&incident, &reflected, cosine, middle - half / sqrt(3.0)) +
                   load_of(&incident, &reflected, cosine, middle + half / sqrt(3.0)));
}
