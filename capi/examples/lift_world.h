/* The world "lift", written by `goodbot table --c`. Its description was checked. */
#ifndef GOODBOT_WORLD_LIFT_H
#define GOODBOT_WORLD_LIFT_H

#include <goodbot.h>

/* A state is a number, from 0 to 7. It says what holds:
   liftAtFloor(lift0,floor0): state / 1 % 4 == 0
   liftAtFloor(lift0,floor1): state / 1 % 4 == 1
   liftAtFloor(lift0,floor2): state / 1 % 4 == 2
   liftAtFloor(lift0,floor3): state / 1 % 4 == 3
   doorOpen(lift0): state / 4 % 2 == 1
*/

static const char *const lift_classes[] = {"lift", "floor"};
static const goodbot_carrier lift_carriers0[] = {{1, "floorName"}};
static const goodbot_attribute lift_attributes[] = {{"name", lift_carriers0, 1}};
static const goodbot_proposition lift_propositions[] = {
    {"liftAtFloor", {0, 1}, 2},
    {"doorOpen", {0}, 1},
    {"above", {1, 1}, 2},
};
static const goodbot_object lift_objects[] = {
    {0, "lift0", {NULL}},
    {1, "floor0", {"garage"}},
    {1, "floor1", {"shop"}},
    {1, "floor2", {"office"}},
    {1, "floor3", {"roof"}},
};
static const goodbot_action lift_actions[] = {{"up", 1}, {"down", 1}, {"open", 1}, {"close", 1}};
static const char *const lift_tasks[] = {"liftAtFloor(\077l,\077f)"};
/* The kinds of task, parsed: their variables' classes, their propositions, and the variables of each. */
static const goodbot_kind lift_kinds[] = {
    {{0, 1}, 2, {0}, 1, {{0, 1, 255}}},
};

/* Facts: a proposition of these objects holds where state / unit % values == value. */
static const struct {
    uint8_t proposition, arguments[GOODBOT_MOST_ARGUMENTS];
    uint32_t unit, values, value;
} lift_facts[] = {
    {0, {0, 1, 0}, 1, 4, 0},
    {0, {0, 2, 0}, 1, 4, 1},
    {0, {0, 3, 0}, 1, 4, 2},
    {0, {0, 4, 0}, 1, 4, 3},
    {1, {0, 0, 0}, 4, 2, 1},
    {2, {2, 1, 0}, 1, 1, 0},
    {2, {3, 2, 0}, 1, 1, 0},
    {2, {4, 3, 0}, 1, 1, 0},
};

/* Rules of actions: 0 begins a rule; 1 is a value that a digit must have, 2 one that it must not have, 3 one that it gets. */
static const struct {
    uint8_t action, kind;
    uint32_t unit, values, value;
} lift_parts[] = {
    {0, 0, 1, 1, 0},
    {0, 1, 1, 4, 0},
    {0, 2, 4, 2, 1},
    {0, 3, 1, 4, 1},
    {0, 0, 1, 1, 0},
    {0, 1, 1, 4, 1},
    {0, 2, 4, 2, 1},
    {0, 3, 1, 4, 2},
    {0, 0, 1, 1, 0},
    {0, 1, 1, 4, 2},
    {0, 2, 4, 2, 1},
    {0, 3, 1, 4, 3},
    {1, 0, 1, 1, 0},
    {1, 1, 1, 4, 1},
    {1, 2, 4, 2, 1},
    {1, 3, 1, 4, 0},
    {1, 0, 1, 1, 0},
    {1, 1, 1, 4, 2},
    {1, 2, 4, 2, 1},
    {1, 3, 1, 4, 1},
    {1, 0, 1, 1, 0},
    {1, 1, 1, 4, 3},
    {1, 2, 4, 2, 1},
    {1, 3, 1, 4, 2},
    {2, 0, 1, 1, 0},
    {2, 2, 4, 2, 1},
    {2, 3, 4, 2, 1},
    {3, 0, 1, 1, 0},
    {3, 1, 4, 2, 1},
    {3, 3, 4, 2, 0},
};

static bool lift_holds(void *context, uint32_t state, uint8_t proposition, const uint8_t *arguments) {
    uint32_t count = lift_propositions[proposition].parameter_count;
    (void)context;
    for (size_t at = 0; at < sizeof lift_facts / sizeof *lift_facts; at++) {
        bool same = lift_facts[at].proposition == proposition && state / lift_facts[at].unit % lift_facts[at].values == lift_facts[at].value;
        for (uint32_t argument = 0; argument < count; argument++) same = same && lift_facts[at].arguments[argument] == arguments[argument];
        if (same) return true;
    }
    return false;
}

static bool lift_step(void *context, uint32_t state, uint8_t action, uint32_t *next) {
    bool fits = false;
    uint32_t after = state;
    (void)context;
    for (size_t at = 0; at < sizeof lift_parts / sizeof *lift_parts; at++) {
        uint32_t unit = lift_parts[at].unit, values = lift_parts[at].values, value = lift_parts[at].value;
        if (lift_parts[at].action != action) continue;
        if (lift_parts[at].kind == 0) {
            if (fits) break; /* the first rule that fits applies */
            fits = true;
            after = state;
        } else if (lift_parts[at].kind == 3) after = after - after / unit % values * unit + value * unit;
        else if ((state / unit % values == value) != (lift_parts[at].kind == 1)) fits = false;
    }
    *next = after;
    return fits;
}

/* In the order of the fields, as C++ wants it. */
static const goodbot_table lift_table = {
    lift_classes, 2, lift_attributes, 1, lift_propositions, 3, lift_objects, 5,
    lift_actions, 4, lift_tasks, 1, 8 /* states */, 1 /* the first */, NULL /* next */, lift_step, lift_holds, NULL /* derived */, NULL, lift_kinds
};

/* With these, every lesson is kept and every plan is exact. Where a pointer has four bytes, the robot takes LIFT_BYTES_32 bytes;
   goodbot_table_size(&lift_capacities) says how many it takes. */
#define LIFT_BYTES_32 13104
#if GOODBOT_CAPACITIES != 25
#error "print these capacities with the goodbot that this library comes from"
#endif
static const goodbot_capacities lift_capacities = { {
    5, /* objects */
    9, /* names */
    49, /* name_bytes */
    0, /* cells */
    4, /* tasks */
    3, /* strategies */
    12, /* beliefs */
    4, /* candidates */
    48, /* candidate_tokens */
    4, /* ground_propositions */
    0, /* goal_entries */
    8, /* states */
    0, /* hashed_states */
    54, /* words */
    658, /* word_bytes */
    5, /* tokens */
    53, /* token_bytes */
    24, /* commands */
    288, /* command_tokens */
    6, /* sessions */
    48, /* sentence_words */
    24, /* pairs */
    288, /* translations */
    545, /* alignments */
    0, /* length_pairs */
} };

#endif
