/* A search for the input that takes the most instructions of a call: worlds, lessons and sentences are drawn from a genome, a list of
   bytes; each call keeps the genome that made it longest, and these are changed further. Each call has the smallest budget, the tables those of the preset
   GOODBOT_OWN, or larger ones with LARGE. Prints the most of each call; with VERBOSE, the genome of each trial, and which calls it made
   longer. `cargo xtask worst` runs it on the emulated board mps2-an386, whose counter it reads. */
#include "goodbot.h"
#include <stdio.h>
#include <string.h>

#ifndef TRIALS
#define TRIALS 4
#endif
#ifndef SEED
#define SEED 1
#endif

/* The robot is in RAM that the program itself does not use. */
static unsigned char *const memory = (unsigned char *)0x21000000;
static unsigned char *const buffer = (unsigned char *)0x21800000;
static unsigned char *const stored = (unsigned char *)0x21900000;
static unsigned char *const kept = (unsigned char *)0x21A00000;
#define MEMORY_BYTES 0x800000
#define BUFFER_BYTES 0x20000

/* ---- counting ---- */

static volatile uint32_t *const systick = (volatile uint32_t *)0xE000E010;

enum call {
    BEGIN_HEARING, HEAR_ON, HEAR_AGAIN, PLAN, DECIDE, DONE, FEEDBACK, TRAINER_ENDED, DEMONSTRATION, REMARK, BEGIN_FINISHING, FINISH_ON,
    FORGET, LEARN, LEARN_16, TASK_COUNT, TASK_PROBABILITY, MOST_LIKELY, TASK_TEXT, EXPLAIN_ON, EXPLAIN_WORD, QUESTION, QUESTION_TEXT, ANSWER,
    SAID, SAID_ALONE, REMEMBER, CONVERSE_ANEW, SESSION_COUNT, USAGE, FULL, SET_STATE, SAVED_SIZE, BEGIN_SAVING, SAVE_ON, BEGIN_RESTORING,
    RESTORE_ON, BEGIN_STORING, STORE_ON, TRAINER, TRAINERS, OPTIONS, SET_OPTIONS, LEAST_CAPACITIES, HOME_FIND_CELLS, HOME_PLACE, HOME_SENSE, HOME_WHERE, CALLS
};
static const char *const names[CALLS] = {
    "begin_hearing", "hear_on", "hear_again", "plan", "decide", "done", "feedback", "trainer_ended", "demonstration", "remark",
    "begin_finishing", "finish_on", "forget", "learn", "learn-16", "task_count", "task_probability", "most_likely", "task_text",
    "explain_on", "explain_word", "question", "question_text", "answer", "said", "said-alone", "remember", "converse_anew", "session_count", "usage", "full",
    "table_set_state", "saved_size", "begin_saving", "save_on", "begin_restoring", "restore_on", "begin_storing", "store_on",
    "trainer", "trainers",
    "current_options", "set_options", "least_capacities", "home_find_cells", "home_place", "home_sense", "home_where",
};
static uint32_t most[CALLS], now[CALLS];

extern uint32_t instructions(void);
static uint32_t begun;
#define COUNT(call, what) (paint(call), begun = systick[2], counted(call, (int32_t)(what)))

/* The deepest stack of each call, by paint below it: of the first calls of a kind, then of one in sixteen, because painting takes long. */
#define PAINT 0xCCCCCCCCu
enum { PAINTED = 4096 };
static uint32_t stacks[CALLS], calls_made[CALLS], *top;

__attribute__((noinline)) static void paint(enum call call) {
    top = NULL;
    if (calls_made[call]++ > 64 && calls_made[call] * 2654435761u >> 28) return;
    __asm__ volatile("mov %0, sp" : "=r"(top));
    for (volatile uint32_t *at = top - 16; at > top - PAINTED; at--) *at = PAINT;
}

__attribute__((noinline)) static int32_t counted(enum call call, int32_t result) {
    uint32_t taken = (uint32_t)(((begun - systick[2]) & 0xFFFFFF) * 25 / 40);
    if (taken > now[call]) now[call] = taken;
    if (top) {
        volatile uint32_t *at = top - PAINTED + 1;
        while (at < top && *at == PAINT) at++;
        if ((uint32_t)(top - at) * 4 > stacks[call]) stacks[call] = (uint32_t)(top - at) * 4;
    }
    return result;
}

/* ---- the genome ---- */

enum { GENES = 22 };
static unsigned char best[CALLS][GENES], genome[GENES];
static uint32_t noise = SEED * 2654435761u + 1;

static uint32_t random_number(void) {
    noise ^= noise << 13;
    noise ^= noise >> 17;
    noise ^= noise << 5;
    return noise;
}

/* From `least` to `greatest`. */
static uint32_t gene(int at, uint32_t least, uint32_t greatest) { return least + genome[at] * (greatest - least + 1) / 256; }

/* Numbers that depend on the genome alone. */
static uint32_t drawn;
static uint32_t draw(uint32_t below) {
    drawn = drawn * 1664525u + 1013904223u;
    return (drawn >> 8) % below;
}

/* ---- the world: a robot carries things between places ---- */

#ifdef LARGE
enum { MOST_PLACES = 12, MOST_THINGS = 3, MOST_TASKS = 64, MOST_NAMES = 96 };
#else
enum { MOST_PLACES = 13, MOST_THINGS = 2, MOST_TASKS = 16, MOST_NAMES = 32 };
#endif
/* A call asks for all derived facts of an object, whatever the budget. */
enum { MOST_FACTS = GOODBOT_MOST_DERIVED };
enum { ROBOT, PLACE, THING };
static uint32_t places, things, states, facts;
static const char *const classes[] = {"robot", "place", "thing"};
static const goodbot_carrier colours[] = {{PLACE, "placeColour"}, {THING, "thingColour"}};
static const goodbot_carrier kinds[] = {{THING, "thingKind"}, {PLACE, "placeKind"}};
static const goodbot_carrier sizes[] = {{THING, "thingSize"}, {PLACE, "placeSize"}};
static const goodbot_attribute attributes[] = {{"colour", colours, 2}, {"kind", kinds, 2}, {"size", sizes, 2}};
static const goodbot_proposition propositions[] = {
    {"robotAt", {ROBOT, PLACE}, 2}, {"thingAt", {THING, PLACE}, 2}, {"beside", {PLACE, PLACE}, 2}, {"carries", {ROBOT, THING}, 2},
};
static const char *const all_tasks[] = {
    "robotAt(?r, ?p)", "thingAt(?t, ?p)", "carries(?r, ?t)", "thingAt(?t, ?p) & robotAt(?r, ?q)",
    "robotAt(?r, ?p) avoiding robotAt(?r, ?q)", "robotAt(?r, ?p) through robotAt(?r, ?q)", "thingAt(?t, ?p) & carries(?r, ?u)",
    "thingAt(?t, ?p) avoiding robotAt(?r, ?q)", "thingAt(?t, ?p) & thingAt(?u, ?q)",
};
enum { KINDS = sizeof all_tasks / sizeof *all_tasks };
static goodbot_object objects[1 + MOST_PLACES + MOST_THINGS];
static char object_names[1 + MOST_PLACES + MOST_THINGS][8], values[40][12];
static goodbot_action actions[15];
static char action_names[15][4];
static const char *tasks[KINDS];
static goodbot_table table;

/* A state: the robot's place, and each thing's, where `places` is the robot's hand. */
static uint32_t place_of(uint32_t state, uint32_t what) {
    if (what == 0) return state % places;
    for (state /= places; --what;) state /= places + 1;
    return state % (places + 1);
}

static bool step(void *context, uint32_t state, uint8_t action, uint32_t *next) {
    uint32_t at = place_of(state, 0), unit = places;
    (void)context;
    if (gene(15, 0, 1)) action %= 4; /* The extra actions do the same as others, or nothing. */
    if (action == 0 && at + 1 < places) { *next = state + 1; return true; }
    if (action == 1 && at > 0) { *next = state - 1; return true; }
    for (uint32_t thing = 1; thing <= things; thing++, unit *= places + 1) {
        uint32_t where = place_of(state, thing);
        if (action == 2 && where == at) { *next = state + (places - at) * unit; return true; }
        if (action == 3 && where == places) { *next = state - (places - at) * unit; return true; }
    }
    return false;
}

static bool holds(void *context, uint32_t state, uint8_t proposition, const uint8_t *of) {
    (void)context;
    switch (proposition) {
    case 0: return place_of(state, 0) == of[1] - 1u;
    case 1: return place_of(state, of[0] - places) == of[1] - 1u;
    case 2: return of[0] + 1 == of[1] || of[1] + 1 == of[0];
    default: return place_of(state, of[1] - places) == places;
    }
}

static const char *derived(void *context, uint32_t state, uint8_t object, uint32_t number) {
    static const char *const told[] = {"first", "last", "even", "odd", "near", "far", "high", "low"};
    (void)context;
    return number < facts && object > 0 ? told[(state + object + number) % 8] : NULL;
}

static void make_world(void) {
    uint32_t value = 0, different, count = 0, kinds_of_task = 0, room = MOST_TASKS, extra = gene(3, 0, 11);
    places = gene(0, 2, MOST_PLACES), things = gene(1, 1, MOST_THINGS), facts = gene(2, 0, MOST_FACTS), states = places;
    for (uint32_t thing = 0; thing < things; thing++) states *= places + 1;
    /* Objects and values share the room for names. */
    different = MOST_NAMES - (1 + places + things);
    different = gene(4, 3, different < 40 ? different : 40);
    memset(objects, 0, sizeof objects);
    for (uint32_t at = 0; at < 40; at++) sprintf(values[at], "v%lu", (unsigned long)at);
    for (uint32_t at = 0; at < 1 + places + things; at++) {
        goodbot_object *object = &objects[count];
        sprintf(object_names[count], "o%lu", (unsigned long)at);
        object->name = object_names[count++];
        object->object_class = at == 0 ? ROBOT : at <= places ? PLACE : THING;
        for (uint32_t attribute = 0; at > 0 && attribute < 3; attribute++) object->values[attribute] = values[value++ % different];
    }
    for (uint32_t at = 0; at < 4 + extra; at++) {
        sprintf(action_names[at], "a%lu", (unsigned long)at);
        actions[at] = (goodbot_action){action_names[at], (uint8_t)(1 + (at * gene(5, 0, 3)) % 4)};
    }
    for (uint32_t at = 0; at < gene(6, 1, 8); at++) {
        uint32_t kind = (at + gene(7, 0, KINDS - 1)) % KINDS, t = things, p = places, pairs = p * (p - 1);
        uint32_t tasks_of_kind[KINDS] = {p, t * p, t, t * pairs, pairs, pairs, t * (t - 1) * p, t * pairs, t * (t - 1) * pairs / 2};
        if (tasks_of_kind[kind] > room) continue;
        room -= tasks_of_kind[kind];
        tasks[kinds_of_task++] = all_tasks[kind];
    }
    if (kinds_of_task == 0) tasks[kinds_of_task++] = all_tasks[0];
    table = (goodbot_table){
        .classes = classes, .class_count = 3, .attributes = attributes, .attribute_count = 3, .propositions = propositions,
        .proposition_count = 4, .objects = objects, .object_count = count, .actions = actions, .action_count = 4 + extra,
        .tasks = tasks, .task_count = kinds_of_task, .state_count = states, .start = 0, .step = step, .holds = holds, .derived = derived,
    };
}

/* ---- lessons ---- */

static char sentence[8192];

/* A sentence of up to 64 words: the words' numbers come from a vocabulary of the genome's size, their letters are alike or not. One sentence
   in eight is long instead: so many letters, dots, blanks, marks or words that most are refused. Letters may be beyond ASCII. */
static void say(int most_words) {
    char *to = sentence;
    static const char *const repeated[] = {"aa", "..", "  ", "a ", "\xc3\xa9", "\xcc\x81"};
    if (!most_words && draw(256) < gene(16, 0, 32)) {
        const char *of = repeated[draw(6)];
        for (uint32_t left = draw(GOODBOT_MOST_COMMAND_BYTES / 2 + 50); left; left--) *to++ = of[0], *to++ = of[1];
        strcpy(to, draw(2) ? " a" : "");
        return;
    }
    uint32_t count = gene(8, 1, 64), vocabulary = gene(9, 1, 200), letters = gene(10, 2, 44), alike = gene(11, 0, 2);
    if (most_words) count = 64;
    for (uint32_t word = 0; word < count && to + 2 * letters < sentence + GOODBOT_MOST_COMMAND_BYTES; word++) {
        uint32_t number = draw(vocabulary);
        for (uint32_t letter = 0; letter < letters; letter++) {
            uint32_t apart = number * (letter + 3) + letter;
            if (alike == 0) apart = number >> (letter % 8);
            if (alike == 1) apart = letter + 4 < letters ? 3 : (number >> 4 * (letter % 4)) & 15;
            if (gene(17, 0, 3) == 3) *to++ = '\xc3', *to++ = (char)(0xa0 + apart % 23);
            else *to++ = (char)('a' + apart % 26);
        }
        *to++ = ' ';
    }
    *to = 0;
}

/* The table of closed words that `goodbot example closed-words` prints, of all languages. */
#define WORDS_OF(language) ".incbin \"core/src/voice/classes/" language ".txt\"\n"
__asm__(".section .rodata.closed_words, \"a\"\nclosed_words:\n" WORDS_OF("english") WORDS_OF("german") WORDS_OF("french") WORDS_OF("spanish")
        WORDS_OF("chinese") ".ascii \"language:\\n\"\n.byte 0\n.previous");
extern const char closed_words[];

#define REQUIRE(status) do { if ((status) != GOODBOT_STATUS_OK) return; } while (0)

static goodbot *robot;
static size_t robot_bytes;
/* Whether this world takes the calls that do all at once, too: they take most of the time of a search. */
static bool is_slow;

/* Learns on. Parts of the work are not measured where the genome says so, because a whole training takes long. */
static void learn(void) {
    uint32_t skip = gene(20, 0, 15), calls = 0;
    goodbot_status status = GOODBOT_STATUS_WORKING;
    while (status == GOODBOT_STATUS_WORKING) {
        bool small = draw(8) > 0;
        status = COUNT(small ? LEARN : LEARN_16, goodbot_learn(robot, small ? 1 : 16));
        if (status == GOODBOT_STATUS_WORKING && skip) status = goodbot_learn(robot, 1 + draw(skip * skip * 40));
        if (++calls > 40000) {
            while (status == GOODBOT_STATUS_WORKING) status = goodbot_learn(robot, 100000);
        }
    }
}

static void ask_about(void) {
    char text[256], word[64];
    uint32_t count, task, sessions, limit, given;
    int32_t answer;
    float number;
    const char *remark;
    goodbot_capacities usage;
    goodbot_said_kind said;
    (void)COUNT(TASK_COUNT, goodbot_task_count(robot, &count));
    (void)COUNT(MOST_LIKELY, goodbot_most_likely(robot, &task));
    (void)COUNT(TASK_PROBABILITY, goodbot_task_probability(robot, draw(64), &number));
    (void)COUNT(TASK_TEXT, goodbot_task_text(robot, draw(64), text, sizeof text));
    task = draw(count ? count : 1);
    while (COUNT(EXPLAIN_ON, goodbot_explain_on(robot, task, 1)) == GOODBOT_STATUS_WORKING) {
    }
    for (uint32_t at = 0; at < 8; at++) {
        (void)COUNT(EXPLAIN_WORD, goodbot_explain_word(robot, task, draw(64), draw(24), word, sizeof word, text, sizeof text, &number));
    }
    (void)COUNT(SESSION_COUNT, goodbot_session_count(robot, &sessions));
    (void)COUNT(USAGE, goodbot_usage(robot, &usage));
    (void)COUNT(FULL, goodbot_full(robot, text, sizeof text, &limit, &given));
    (void)COUNT(REMARK, goodbot_remark(robot, &remark));
    (void)COUNT(SAID_ALONE, goodbot_said(robot, sentence, NULL, &said, &answer));
    if (!is_slow) return;
    uint32_t before = instructions();
    (void)COUNT(SAID, goodbot_said(robot, sentence, closed_words, &said, &answer));
    uint32_t taken = instructions() - before;
    /* The counter runs over after ten million. To paint the stack takes part of this. */
    if (taken > 8000000 && taken > now[SAID]) now[SAID] = taken;
}

/* "Stop" may come at any moment. The robot then goes on as if it had not: its memory is put back. */
static void stop(void) {
    memcpy(kept, memory, robot_bytes);
    (void)COUNT(FORGET, goodbot_forget(robot));
    memcpy(memory, kept, robot_bytes);
}

static goodbot_status hear(void) {
    goodbot_status status = COUNT(BEGIN_HEARING, goodbot_begin_hearing(robot, sentence));
    if (status != GOODBOT_STATUS_OK) return status;
    do {
        status = COUNT(HEAR_ON, goodbot_hear_on(robot, 1));
        if (draw(64) == 0) stop();
    } while (status == GOODBOT_STATUS_WORKING);
    return status;
}

static void act(uint32_t turns) {
    for (uint32_t turn = 0; turn < turns; turn++) {
        uint8_t action = GOODBOT_NOOP;
        uint32_t plan, evidence, kind, choices;
        goodbot_status status;
        char text[128];
        (void)COUNT(SET_STATE, goodbot_table_set_state(robot, draw(states)));
        do {
            status = COUNT(PLAN, goodbot_plan(robot, 1));
            if (draw(64) == 0) stop();
        } while (status == GOODBOT_STATUS_WORKING);
        if (draw(3) == 0) {
            do status = COUNT(QUESTION, goodbot_question(robot, 0.1f, 0.05f, 1, &kind, &choices));
            while (status == GOODBOT_STATUS_WORKING);
            (void)COUNT(QUESTION_TEXT, goodbot_question_text(robot, 0, text, sizeof text));
            (void)COUNT(ANSWER, goodbot_answer(robot, (int32_t)draw(3) - 1, &evidence));
        }
        (void)COUNT(DECIDE, goodbot_decide(robot, &action, &plan));
        if (draw(4) == 0) action = (uint8_t)draw(4);
        (void)COUNT(DONE, goodbot_acted(robot, action));
        (void)COUNT(FEEDBACK, goodbot_feedback(robot, (int32_t)draw(3) - 1, &evidence));
        if (draw(8) == 0) (void)COUNT(DEMONSTRATION, goodbot_demonstration(robot, (uint8_t)draw(4), &evidence));
    }
}

/* All kinds of trainers that the tables hold, with all that a strategy can say. */
static void trained_by_many(void) {
    goodbot_strategy strategies[GOODBOT_MOST_STRATEGIES];
    for (uint32_t at = 0; at < GOODBOT_MOST_STRATEGIES; at++) {
        strategies[at] = (goodbot_strategy){0.1f, 0.7f, 0.1f, {0.6f, 0.3f, 0.1f}, {0.3f, 0.4f, 0.5f, 0.6f}, 1.0f + (float)at};
    }
    for (uint32_t count = GOODBOT_MOST_STRATEGIES; count > 0; count--) (void)COUNT(TRAINERS, goodbot_trainers(robot, strategies, count));
}

/* A home in which everything has a long name: as many rooms and blocks as fit the preset for homes, in its cells. */
static void live_in_a_home(void) {
    static goodbot_capacities capacities;
    static char names[12][48];
    goodbot_sensed sensed[13];
    uint32_t rooms = gene(0, 1, 3), blocks = gene(1, 0, 3), letters = gene(10, 1, 14), moves;
    int32_t wide = (int32_t)gene(3, 2, 5), x, y;
    goodbot_status status;
    REQUIRE(goodbot_preset(GOODBOT_SMALL, &capacities));
    REQUIRE(goodbot_init_home(memory, MEMORY_BYTES, &capacities, &robot));
    REQUIRE(goodbot_home_begin(robot));
    for (uint32_t at = 0; at < 12; at++) {
        memset(names[at], 'n', letters);
        names[at][letters] = (char)('a' + at);
        names[at][letters + 1] = 0;
    }
    for (uint32_t at = 0; at < rooms; at++) {
        int32_t left = (int32_t)at * wide;
        REQUIRE(goodbot_home_room(robot, names[at], left, 0, left + wide, 4, "red"));
        if (at > 0) REQUIRE(goodbot_home_door(robot, names[3 + at], left, 2, left, 2));
    }
    REQUIRE(goodbot_home_agent(robot, names[6], 1, 1));
    for (uint32_t at = 0; at < blocks; at++) REQUIRE(goodbot_home_block(robot, names[7 + at], 1 + (int32_t)(at % 2), 2 + (int32_t)(at / 2), "blue", "chair"));
    do status = COUNT(HOME_FIND_CELLS, goodbot_home_find_cells(robot, 1));
    while (status == GOODBOT_STATUS_WORKING);
    REQUIRE(status);
    REQUIRE(goodbot_home_build(robot));
    for (moves = 0; moves < 4; moves++) {
        (void)COUNT(HOME_PLACE, goodbot_home_place(robot, names[draw(12)], 1 + (int32_t)draw(4), 1 + (int32_t)draw(3)));
        (void)COUNT(HOME_WHERE, goodbot_home_where(robot, names[draw(12)], &x, &y));
        for (uint32_t at = 0; at <= blocks; at++) sensed[at] = (goodbot_sensed){names[6 + at], 1 + (int32_t)(at % 2), 1 + (int32_t)(at / 2)};
        (void)COUNT(HOME_SENSE, goodbot_home_sense(robot, sensed, blocks + 1));
    }
}

/* A flash in RAM, which takes no time. */
static bool read_flash(void *context, uint32_t at, uint8_t *to, uint32_t bytes) {
    (void)context;
    memcpy(to, stored + at, bytes);
    return true;
}

static bool write_flash(void *context, uint32_t at, const uint8_t *from, uint32_t bytes) {
    (void)context;
    memcpy(stored + at, from, bytes);
    return true;
}

static bool erase_flash(void *context, uint32_t at, uint32_t bytes) {
    (void)context, (void)at, (void)bytes;
    return true;
}

static const goodbot_flash flash = {.read = read_flash, .write = write_flash, .erase = erase_flash, .slot_bytes = BUFFER_BYTES};

static void live(void) {
    static goodbot_capacities capacities;
    static goodbot_saving saving;
    static goodbot_restoring restoring;
    static goodbot_storing storing;
    goodbot_lessons lessons = {4, 64, 64, 1024};
    goodbot_options options;
    size_t bytes, written;
    uint32_t evidence, gave_way, number = gene(21, 0, 3) ? gene(12, 1, 5) : gene(12, 6, 24), turns = gene(13, 0, 6);
    goodbot_status status;
    drawn = genome[14];
    make_world();
    REQUIRE(goodbot_preset(GOODBOT_OWN, &capacities));
#ifdef LARGE
    static const struct { uint32_t capacity, entries; } large[] = {
        {GOODBOT_CAPACITY_OBJECTS, 32}, {GOODBOT_CAPACITY_NAMES, 96}, {GOODBOT_CAPACITY_NAME_BYTES, 1024}, {GOODBOT_CAPACITY_TASKS, 64},
        {GOODBOT_CAPACITY_BELIEFS, 192}, {GOODBOT_CAPACITY_CANDIDATES, 64}, {GOODBOT_CAPACITY_CANDIDATE_TOKENS, 3840},
        {GOODBOT_CAPACITY_GROUND_PROPOSITIONS, 64}, {GOODBOT_CAPACITY_STATES, 65536}, {GOODBOT_CAPACITY_WORDS, 128},
        {GOODBOT_CAPACITY_WORD_BYTES, 2048}, {GOODBOT_CAPACITY_TOKENS, 64}, {GOODBOT_CAPACITY_TOKEN_BYTES, 1024},
        {GOODBOT_CAPACITY_COMMANDS, 256}, {GOODBOT_CAPACITY_COMMAND_TOKENS, 8192}, {GOODBOT_CAPACITY_SESSIONS, 32},
        {GOODBOT_CAPACITY_SENTENCE_WORDS, 2048}, {GOODBOT_CAPACITY_PAIRS, 1024}, {GOODBOT_CAPACITY_TRANSLATIONS, 8320},
        {GOODBOT_CAPACITY_ALIGNMENTS, 8192},
    };
    for (size_t at = 0; at < sizeof large / sizeof *large; at++) capacities.entries[large[at].capacity] = large[at].entries;
#endif
    robot_bytes = goodbot_table_size(&capacities);
    status = goodbot_init_table(memory, MEMORY_BYTES, &capacities, &table, &robot);
    if (status != GOODBOT_STATUS_OK) {
        char why[200];
        if (goodbot_explain_table(memory, MEMORY_BYTES, &capacities, &table, why, sizeof why) != GOODBOT_STATUS_OK) puts(why);
        return;
    }
    for (uint32_t lesson = 0; lesson < number; lesson++) {
        say(0);
        REQUIRE(goodbot_table_set_state(robot, draw(states)));
        status = hear();
        if (status != GOODBOT_STATUS_OK) continue; /* a table is full */
        act(turns);
        if (lesson + 1 == number) {
            ask_about();
            (void)COUNT(HEAR_AGAIN, goodbot_hear_again(robot));
            (void)COUNT(REMEMBER, goodbot_remember(robot, 0));
        }
        if (draw(8) == 0) {
            (void)COUNT(FORGET, goodbot_forget(robot));
            continue;
        }
        status = COUNT(BEGIN_FINISHING, goodbot_begin_finishing(robot));
        do {
            status = COUNT(FINISH_ON, goodbot_finish_on(robot, 1, &gave_way));
            if (status == GOODBOT_STATUS_WORKING) stop();
        } while (status == GOODBOT_STATUS_WORKING);
        if (lesson + 1 == number || draw(4) == 0) learn();
        else
            while (goodbot_learn(robot, 100000) == GOODBOT_STATUS_WORKING) {
            }
    }
    (void)COUNT(TRAINER_ENDED, goodbot_trainer_ended(robot, &evidence));
    (void)COUNT(CONVERSE_ANEW, goodbot_converse_anew(robot));
    (void)COUNT(SAVED_SIZE, goodbot_saved_size(robot, &bytes));
    (void)COUNT(LEAST_CAPACITIES, goodbot_least_capacities(robot, &lessons, &capacities));
    (void)COUNT(OPTIONS, goodbot_current_options(robot, &options));
    (void)COUNT(SET_OPTIONS, goodbot_set_options(robot, &options));
    (void)COUNT(BEGIN_SAVING, goodbot_begin_saving(&saving, buffer, BUFFER_BYTES));
    do status = COUNT(SAVE_ON, goodbot_save_on(robot, &saving, 1, &written));
    while (status == GOODBOT_STATUS_WORKING);
    if (status != GOODBOT_STATUS_OK) return;
    (void)COUNT(BEGIN_STORING, goodbot_begin_storing(&storing, &flash, buffer, written));
    while (COUNT(STORE_ON, goodbot_store_on(&storing, 1)) == GOODBOT_STATUS_WORKING) {
    }
    (void)COUNT(BEGIN_RESTORING, goodbot_begin_restoring(&restoring, buffer, written));
    do status = COUNT(RESTORE_ON, goodbot_restore_on(robot, &restoring, 1));
    while (status == GOODBOT_STATUS_WORKING);
    while (goodbot_learn(robot, 100000) == GOODBOT_STATUS_WORKING) {
    }
    say(1);
    if (hear() == GOODBOT_STATUS_OK) {
        act(1);
        ask_about();
    }
    (void)COUNT(FORGET, goodbot_forget(robot));
    (void)COUNT(TRAINER, goodbot_trainer(robot, 0.7f, 0.7f, 0.1f));
    trained_by_many();
    live_in_a_home();
}

/* The calls that do all at once, which may take as long as they do. */
static bool is_bounded(int call) {
    return call != SAID && call != LEAST_CAPACITIES;
}

/* One of the calls that a control loop makes: the longest of three. */
static int drawn_call(void) {
    int chosen = CALLS;
    for (int draws = 3; draws > 0 || chosen == CALLS; draws--) {
        int other = (int)(random_number() % CALLS);
        if (is_bounded(other) && (chosen == CALLS || most[other] > most[chosen])) chosen = other;
    }
    return chosen;
}

int main(void) {
    for (uint32_t trial = 0; trial < TRIALS; trial++) {
        if (trial == 0) {
            for (int at = 0; at < GENES; at++) genome[at] = 128;
        } else if (trial % 4 == 1) {
            for (int at = 0; at < GENES; at++) genome[at] = (unsigned char)(random_number() >> 9);
        } else {
            memcpy(genome, best[drawn_call()], sizeof genome);
            for (uint32_t changes = 1 + random_number() % 4; changes; changes--) genome[random_number() % GENES] = (unsigned char)(random_number() >> 9);
        }
        memset(now, 0, sizeof now);
        is_slow = trial % 8 == 0;
        live();
        for (int call = 0; call < CALLS; call++) {
            if (now[call] <= most[call]) continue;
            most[call] = now[call];
            memcpy(best[call], genome, sizeof genome);
#ifdef VERBOSE
            if (most[call] > 40000) printf("%s %lu; ", names[call], (unsigned long)most[call]);
#endif
        }
#ifdef VERBOSE
        printf("genome");
        for (int at = 0; at < GENES; at++) printf(" %d", genome[at]);
        printf("\ntrial %lu: %lu places, %lu things\n", (unsigned long)trial, (unsigned long)places, (unsigned long)things);
        fflush(stdout);
#endif
    }
    for (int call = 0; call < CALLS; call++) {
        printf("%s %lu\nstack-%s %lu\n", names[call], (unsigned long)most[call], names[call], (unsigned long)stacks[call]);
    }
    return 0;
}
