/* Particles with a depth: what axisymmetry and plane stress must keep. */
#include "populations.h"
#include "running.h"

static const struct variant plain = {"plain", 1, 1.0, NULL, false};

/* Full of metal under pressure from the axis to a wall, between two others. */
static const char can[] =
    "format: 1\n"
    "dimension: 2\n"
    "geometry: axisymmetric\n"
    "resolution: 1 mm\n"
    "solver: {sph: {method: contact, smoothing: 1}}\n"
    "materials:\n"
    "  aluminium:\n"
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: 2.17, "
    "bulk_modulus: 73 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 4 GPa}}\n"
    "bodies:\n"
    "  filling: {material: aluminium, box: {from: [0 mm, 0 mm], to: [12 mm, 9 mm]}, "
    "pressure: 2 GPa}\n"
    "walls:\n"
    "  mantle: {mirror: x, at: 12 mm, side: high}\n"
    "  below: {mirror: y, at: 0 mm, side: low}\n"
    "  above: {mirror: y, at: 9 mm, side: high}\n"
    "run: {until: 1 s}\n";

static const char *const smoothings[] = {"solver.sph.smoothing=1", "solver.sph.smoothing=1.2",
                                         "solver.sph.smoothing=1.5"};

/* A stress that is alike along the radius and round the axis, and another along it: no force
 * either. */
static void press(struct running *run)
{
    const struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++) {
        p->deviator[i][0] = p->deviator[i][2] = 0.5e9;
        p->deviator[i][1] = -1e9;
    }
}

static void a_uniform_state_between_axis_and_walls_stays_uniform(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(smoothings); k++) {
        const struct variant variant = {"", 1, 1.0, smoothings[k], false};
        struct running *run = begin_fresh(can, &variant);
        const struct particles *p = particles_of(&run->simulation);
        press(run);
        const double density = p->density[0], pressure = p->pressure[0];
        double worst = 0.0;
        step(run, 50);
        for (int32_t i = 0; i < p->count; i++) {
            worst = maximum(worst, fabs(p->density[i] / density - 1.0));
            worst = maximum(worst, fabs(p->pressure[i] / pressure - 1.0));
            worst = maximum(worst, fabs(p->deviator[i][0] / 0.5e9 - 1.0));
            worst = maximum(worst, fabs(p->velocity[i][0]) / 5350.0);
            worst = maximum(worst, fabs(p->velocity[i][1]) / 5350.0);
        }
        print_message("%s: %.2g\n", smoothings[k], worst);
        assert_true(worst < 1e-12);
        end(run);
    }
}

/* u = c r: the rates along the radius and round the axis are alike to the last digits, at the axis
 * too. */
static void a_uniform_expansion_from_the_axis_has_no_shear(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(smoothings); k++) {
        const struct variant variant = {"", 1, 1.0, smoothings[k], false};
        struct running *run = begin_fresh(can, &variant);
        const struct particles *p = particles_of(&run->simulation);
        const double speed = 2e4;
        for (int32_t i = 0; i < p->count; i++)
            p->velocity[i][0] = speed * p->position[i][0];
        assert_success(run->solver->prepare(&run->sph, &run->simulation, &run->limit));
        const double(*rate)[6] = particles_field(p, "strain_rate");
        const double(*acceleration)[3] = particles_field(p, "acceleration");
        for (int32_t i = 0; i < p->count; i++) {
            if (p->position[i][0] > 8e-3)
                continue; /* a wall that stands still is in the way */
            assert_near(rate[i][0], speed, 0.05 * speed);
            assert_near(rate[i][2], rate[i][0], 1e-12 * speed);
            assert_near(rate[i][1], 0.0, 1e-12 * speed);
            assert_near(rate[i][3], 0.0, 1e-12 * speed);
            assert_near(acceleration[i][1], 0.0, 1e-3);
        }
        end(run);
    }
}

/* A ball of metal that flies apart: momentum along the axis and total energy, the axis and its hoop
 * stress booked. */
static const char burst[] =
    "format: 1\n"
    "dimension: 2\n"
    "geometry: axisymmetric\n"
    "resolution: 1 mm\n"
    "solver: {sph: {method: contact, smoothing: 1.2}}\n"
    "materials:\n"
    "  aluminium:\n"
    "    eos: {mie-grueneisen: {density: 2700 kg/m^3, sound: 5350 m/s, slope: 1.35, gamma: 2.17, "
    "bulk_modulus: 73 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 23 GPa, yield: 0.4 GPa}}\n"
    "bodies:\n"
    "  ball: {material: aluminium, pressure: 3 GPa, velocity: [-300 m/s, 200 m/s],\n"
    "         intersection: [{ball: {center: [0 mm, 0 mm], radius: 8 mm}},\n"
    "                        {box: {from: [0 mm, -8 mm], to: [8 mm, 8 mm]}}]}\n"
    "run: {until: 1 s}\n";

static void a_burst_keeps_energy_and_momentum_along_the_axis(void **state)
{
    (void)state;
    struct running *run = begin_fresh(burst, &plain);
    const struct particles *p = particles_of(&run->simulation);
    struct totals start = population_totals(population_of_particles(p), &run->ranks, -1);
    step(run, 60);
    struct totals now = population_totals(population_of_particles(p), &run->ranks, -1);
    struct totals booked = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_CAUSES);
    struct totals axis = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_AXIS);
    assert_near(now.entry[LEDGER_ENERGY], start.entry[LEDGER_ENERGY],
                1e-13 * start.entry[LEDGER_ENERGY]);
    assert_near(now.entry[LEDGER_MOMENTUM_Y], start.entry[LEDGER_MOMENTUM_Y],
                1e-13 * now.momentum_scale);
    double radial = now.entry[LEDGER_MOMENTUM_X] - start.entry[LEDGER_MOMENTUM_X];
    assert_true(radial > 0.1 * now.momentum_scale);
    assert_near(radial, booked.entry[LEDGER_MOMENTUM_X], 1e-13 * now.momentum_scale);
    assert_true(axis.entry[LEDGER_MOMENTUM_X] == booked.entry[LEDGER_MOMENTUM_X]);
    assert_true(booked.entry[LEDGER_ENERGY] == 0.0);
    end(run);
}

/* A free ring, four particles thick, between walls along the axis. */
static const char ring[] =
    "format: 1\n"
    "dimension: 2\n"
    "geometry: axisymmetric\n"
    "resolution: 2 mm\n"
    "solver: sph\n"
    "materials:\n"
    "  steel:\n"
    "    eos: {barotropic: {density: 7900 kg/m^3, bulk_modulus: 176 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 83 GPa, yield: 100 GPa}}\n"
    "bodies:\n"
    "  ring: {material: steel, box: {from: [46 mm, 0 mm], to: [54 mm, 8 mm]}, "
    "velocity: [1 m/s, 0 m/s]}\n"
    "walls:\n"
    "  below: {mirror: y, at: 0 mm, side: low}\n"
    "  above: {mirror: y, at: 8 mm, side: high}\n"
    "run: {until: 1 s}\n";

/* omega^2 = E/((1 - nu^2) rho R^2), with the correction of (thickness/R)^2 left out; the kernel's
 * sums are a per cent too large on a lattice, and it starts with its waves through the
 * thickness. */
static void a_free_ring_breathes_at_its_frequency(void **state)
{
    (void)state;
    const double bulk = 176e9, shear = 83e9, modulus = 9.0 * bulk * shear / (3.0 * bulk + shear);
    const double nu = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
    const double omega = sqrt(modulus / ((1.0 - square(nu)) * 7900.0)) / 50e-3;
    struct running *run = begin_fresh(ring, &plain);
    double momentum = 1.0, before = 1.0, dt = 0.0;
    while (momentum > 0.0 && run->simulation.step < 10000) {
        before = momentum;
        dt = run->simulation.time;
        step(run, 1);
        dt = run->simulation.time - dt;
        struct totals now =
            population_totals(simulation_population(&run->simulation), &run->ranks, -1);
        momentum = now.entry[LEDGER_MOMENTUM_X];
    }
    double quarter = run->simulation.time - dt * momentum / (momentum - before);
    print_message("a quarter of its period: %.4g s of %.4g s\n", quarter, 0.5 * 3.14159265 / omega);
    assert_near(omega * quarter, 0.5 * 3.14159265, 0.03 * 0.5 * 3.14159265);
    end(run);
}

/* Volumes of revolution, a radian of them. */
static void mass_is_that_of_a_radian(void **state)
{
    (void)state;
    struct running *run = begin_fresh(can, &plain);
    struct totals totals =
        population_totals(simulation_population(&run->simulation), &run->ranks, -1);
    double density = particles_of(&run->simulation)->density[0];
    assert_near(totals.entry[LEDGER_MASS], density * 0.5 * square(12e-3) * 9e-3,
                1e-12 * totals.entry[LEDGER_MASS]);
    end(run);
}

static const char walled[] =
    "format: 1\n"
    "dimension: 2\n"
    "resolution: 1 mm\n"
    "solver: sph\n"
    "materials:\n"
    "  m:\n"
    "    eos: {barotropic: {density: 7900 kg/m^3, bulk_modulus: 176 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 83 GPa, yield: 0.5 GPa}}\n"
    "bodies: {b: {material: m, box: {from: [0 mm, 0 mm], to: [8 mm, 8 mm]}}}\n"
    "walls: {floor: {mirror: y, at: 0 mm, side: low}}\n"
    "run: {until: 1 s}\n";

/* A ring without neighbours flies through the axis, as it would. */
static void a_particle_comes_out_on_the_other_side_of_the_axis(void **state)
{
    (void)state;
    struct running *run = begin_fresh(can, &plain);
    struct particles *p = particles_of(&run->simulation);
    p->position[0][0] = -2e-3;
    p->velocity[0][0] = -50.0;
    p->deviator[0][3] = 7.0;
    sph_return_strays(&run->simulation, particles_of(&run->simulation));
    assert_true(p->position[0][0] == 2e-3 && p->velocity[0][0] == 50.0);
    assert_true(p->deviator[0][3] == -7.0);
    struct totals axis = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_AXIS);
    assert_true(axis.entry[LEDGER_MOMENTUM_X] == p->mass[0] * 100.0);
    end(run);
}

/* The same at a wall, here across y. */
static void a_particle_comes_out_of_a_wall_as_its_image(void **state)
{
    (void)state;
    struct running *run = begin_fresh(walled, &plain);
    struct particles *p = particles_of(&run->simulation);
    struct totals before = population_totals(population_of_particles(p), &run->ranks, -1);
    p->position[0][1] = -1e-4;
    p->velocity[0][0] = 30.0;
    p->velocity[0][1] = -50.0;
    p->deviator[0][0] = 3.0;
    p->deviator[0][3] = 7.0;
    struct totals through = population_totals(population_of_particles(p), &run->ranks, -1);
    sph_return_strays(&run->simulation, particles_of(&run->simulation));
    assert_true(p->position[0][1] == 1e-4);
    assert_true(p->velocity[0][0] == 30.0 && p->velocity[0][1] == 50.0);
    assert_true(p->deviator[0][0] == 3.0 && p->deviator[0][3] == -7.0);
    struct totals after = population_totals(population_of_particles(p), &run->ranks, -1),
                  walls = ledger_totals(&run->simulation.ledger, &run->ranks, LEDGER_WALLS);
    const enum ledger_entry entries[] = {LEDGER_MOMENTUM_Y, LEDGER_ANGULAR_Z, LEDGER_ENERGY};
    for (int k = 0; k < 3; k++)
        assert_near(after.entry[entries[k]] - through.entry[entries[k]], walls.entry[entries[k]],
                    1e-12 * (fabs(after.entry[entries[k]]) + 1e-3));
    assert_true(before.entry[LEDGER_MASS] == after.entry[LEDGER_MASS]);
    end(run);
}

static const char sheet[] =
    "format: 1\n"
    "dimension: 2\n"
    "geometry: plane-stress\n"
    "resolution: 1 mm\n"
    "solver: sph\n"
    "materials:\n"
    "  steel:\n"
    "    eos: {barotropic: {density: 7900 kg/m^3, bulk_modulus: 176 GPa}}\n"
    "    strength: {perfect-plastic: {shear_modulus: 83 GPa, yield: 0.5 GPa}}\n"
    "bodies:\n"
    "  sheet: {material: steel, box: {from: [-5 mm, -5 mm], to: [5 mm, 5 mm]}}\n"
    "run: {until: 1 s}\n";

/* A small strain in the plane: [sigma_xx sigma_yy] = E/(1 - nu^2) [1 nu; nu 1] [strain_xx
 * strain_yy]. */
static void a_thin_plate_has_the_stiffness_of_plane_stress(void **state)
{
    (void)state;
    const double bulk = 176e9, shear = 83e9;
    const double modulus = 9.0 * bulk * shear / (3.0 * bulk + shear);
    const double nu = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
    struct running *run = begin_fresh(sheet, &plain);
    struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++) {
        p->velocity[i][0] = 3.0 * p->position[i][0];
        p->velocity[i][1] = -1.0 * p->position[i][1];
    }
    step_of(run, 1e-8);
    const double(*rate)[6] = particles_field(p, "strain_rate");
    const double *thickness = particles_field(p, "thickness");
    for (int32_t i = 0; i < p->count; i++) {
        double xx = 1e-8 * rate[i][0], yy = 1e-8 * rate[i][1], size = 3e-8 * modulus;
        double factor = modulus / (1.0 - square(nu));
        assert_near(p->deviator[i][0] - p->pressure[i], factor * (xx + nu * yy), 1e-6 * size);
        assert_near(p->deviator[i][1] - p->pressure[i], factor * (yy + nu * xx), 1e-6 * size);
        assert_near(p->deviator[i][2] - p->pressure[i], 0.0, 1e-13 * modulus);
        assert_near(thickness[i] - 1.0, -nu / (1.0 - nu) * (xx + yy), 1e-6 * 3e-8);
    }
    end(run);
}

/* Pulled far beyond its yield stress. */
static void a_plate_that_flows_bears_nothing_across(void **state)
{
    (void)state;
    struct running *run = begin_fresh(sheet, &plain);
    struct particles *p = particles_of(&run->simulation);
    for (int32_t i = 0; i < p->count; i++)
        p->velocity[i][0] = 3e4 * p->position[i][0];
    step(run, 40);
    const double *thickness = particles_field(p, "thickness");
    double flow = 0.0;
    for (int32_t i = 0; i < p->count; i++) {
        assert_near(p->deviator[i][2] - p->pressure[i], 0.0, 1e-13 * 286e9);
        assert_true(thickness[i] > 0.5 && thickness[i] < 1.1);
        flow = maximum(flow, p->plastic_strain[i]);
    }
    assert_true(flow > 0.05);
    end(run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_uniform_state_between_axis_and_walls_stays_uniform),
        cmocka_unit_test(a_uniform_expansion_from_the_axis_has_no_shear),
        cmocka_unit_test(a_burst_keeps_energy_and_momentum_along_the_axis),
        cmocka_unit_test(a_free_ring_breathes_at_its_frequency),
        cmocka_unit_test(mass_is_that_of_a_radian),
        cmocka_unit_test(a_particle_comes_out_on_the_other_side_of_the_axis),
        cmocka_unit_test(a_particle_comes_out_of_a_wall_as_its_image),
        cmocka_unit_test(a_thin_plate_has_the_stiffness_of_plane_stress),
        cmocka_unit_test(a_plate_that_flows_bears_nothing_across),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
