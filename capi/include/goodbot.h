/* goodbot: a robot that learns what your words mean from reward and punishment. docs/robot.md leads through a whole program.

   The order of calls, each function's own rules beside it:

     goodbot_preset, goodbot_init_home          a robot, in your memory; goodbot_init_table for one that is no home
     goodbot_restore, goodbot_learn ...         a saved model, if there is one
     goodbot_home_begin ... goodbot_home_build  the home
     goodbot_hear                               a command: a session begins
       goodbot_plan ..., goodbot_decide         an action; you do it
       goodbot_acted                            it was done; goodbot_home_sense if things are elsewhere than described
       goodbot_feedback                         the trainer's feedback to it, until the next action is done
     goodbot_finish, goodbot_learn ...          the session is learned; goodbot_forget if it shall not be
     goodbot_save                               the model as bytes; goodbot_store and goodbot_load for a flash

   Rules for all of them:

   - Every function that can fail returns a status; GOODBOT_STATUS_OK is 0. A call that fails changes nothing, unless its text says so.
   - Memory is yours, aligned to 8. It must stay in place and hold nothing else; nothing has to be freed. A handle that was copied or moved
     is told by GOODBOT_STATUS_BAD_HANDLE.
   - Texts are UTF-8 and end with 0. They are copied, but for those that a goodbot_table points to.
   - Nothing is global: robots do not know of each other. One robot is one thread's at a time.
   - No function may be called for a robot while another is under way for it: an interrupt handler sets a flag, the control loop looks at
     it and calls goodbot_feedback. A call from an interrupt or from a function of yours answers GOODBOT_STATUS_BUSY and does nothing.
   - A function with a budget does about as much work as the budget says and no more. With the preset GOODBOT_OWN, at most eight derived facts of
     an object and the budget 1, no call takes more than 62,500 instructions on a Cortex-M4F, or 200,000 on a Cortex-M0, with any input that a
     search found; docs/footprint.md has each. These do all at once instead, or much of it, so a control loop leaves them to its start, or to
     moments when the robot may wait: goodbot_init_table, goodbot_explain_table, goodbot_least_capacities, goodbot_hear, goodbot_hear_one_of,
     goodbot_hear_one_of_logs, goodbot_said with a table of words, goodbot_listen, goodbot_listen_on, goodbot_correct, goodbot_finish,
     goodbot_home_build, goodbot_join_starter, goodbot_save, goodbot_store, goodbot_restore, goodbot_load, goodbot_save_parameters and
     goodbot_restore_parameters; and goodbot_explain_word, unless goodbot_explain_on was called first. */

#ifndef GOODBOT_H
#define GOODBOT_H

/* Written by `cargo xtask capi`; do not change it by hand. */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The library's version.
#define GOODBOT_VERSION_MAJOR 0
#define GOODBOT_VERSION_MINOR 1
#define GOODBOT_VERSION_PATCH 0

// The features of the library that this header came with: 1 for those that it has. Only their functions are there to be linked.
#define GOODBOT_HAS_ASKING 1
#define GOODBOT_HAS_BOUNDS 1
#define GOODBOT_HAS_CHECKS 1
#define GOODBOT_HAS_EXPLAIN 1
#define GOODBOT_HAS_FORGETTING 1
#define GOODBOT_HAS_HOME 1
#define GOODBOT_HAS_LEARNING 1
#define GOODBOT_HAS_TABLE 1
#define GOODBOT_HAS_TALK 1
#define GOODBOT_HAS_UNICODE 1
#define GOODBOT_HAS_VOICE 1
#define GOODBOT_HAS_WAYS 1

// Warns where the result of a function is not used. Define it as nothing before the header is included, if that is too strict.
#ifndef GOODBOT_MUST_USE
#if (defined(__cplusplus) && __cplusplus >= 201703L) || (defined(__STDC_VERSION__) && __STDC_VERSION__ >= 202311L)
#define GOODBOT_MUST_USE [[nodiscard]]
#elif defined(__GNUC__)
#define GOODBOT_MUST_USE __attribute__((warn_unused_result))
#else
#define GOODBOT_MUST_USE
#endif
#endif

// The version of this interface. It rises when a program that was compiled with an older header would go wrong.
#define GOODBOT_API_VERSION 2

// How many capacities there are.
#define GOODBOT_CAPACITIES 25

// The preset for homes on controllers.
#define GOODBOT_SMALL 0

// The preset for the smallest controllers. Its robot expects one strategy only, a trainer who uses both words. For one button take
// `goodbot_trainer(robot, 0.05f, 0.7f, 0.1f)` if it praises and `goodbot_trainer(robot, 0.7f, 0.05f, 0.1f)` if it blames, and tell silence;
// or raise `STRATEGIES` to 3 and `BELIEFS` to 3 times `TASKS`, and the robot finds out which.
#define GOODBOT_TINY 1

// The preset for a robot of the caller's own on a controller: 16 tasks, 5,888 states, and 24 lessons of 44 different words. It has no room
// for a home.
#define GOODBOT_OWN 2

// The preset for hosts, about seven megabytes: `goodbot_size` and `goodbot_table_size` say how many exactly. With it, `goodbot_usage` and
// `goodbot_least_capacities` find the capacities that a controller needs.
#define GOODBOT_STANDARD 3

// Bytes that the small preset takes where a pointer has four bytes.
#define GOODBOT_SMALL_BYTES_32 21920

// Bytes that the small preset takes where a pointer has eight bytes.
#define GOODBOT_SMALL_BYTES_64 22528

// Bytes that the tiny preset takes where a pointer has four bytes.
#define GOODBOT_TINY_BYTES_32 13600

// Bytes that the tiny preset takes where a pointer has eight bytes.
#define GOODBOT_TINY_BYTES_64 14144

// Bytes that the preset for a robot of one's own takes where a pointer has four bytes.
#define GOODBOT_OWN_BYTES_32 28320

// Bytes that the preset for a robot of one's own takes where a pointer has eight bytes.
#define GOODBOT_OWN_BYTES_64 28896

// Bytes that a robot of the caller's own takes beyond the small or the tiny preset.
#define GOODBOT_TABLE_BYTES 1344

// The most bytes of the small preset's model: a buffer for it. A slot of a flash takes `GOODBOT_FLASH_UNIT` more.
#define GOODBOT_SMALL_MODEL_BYTES 3830

// The most bytes of the tiny preset's model.
#define GOODBOT_TINY_MODEL_BYTES 2752

// The most bytes of the model of the preset for a robot of one's own.
#define GOODBOT_OWN_MODEL_BYTES 5778

// Most kinds of tasks.
#define GOODBOT_MOST_TASKS 8

// Most classes.
#define GOODBOT_MOST_CLASSES 8

// Most attributes.
#define GOODBOT_MOST_ATTRIBUTES 4

// Most carriers of all attributes together.
#define GOODBOT_MOST_CARRIERS 16

// Most propositional functions.
#define GOODBOT_MOST_PROPOSITIONS 8

// Most arguments of a propositional function.
#define GOODBOT_MOST_ARGUMENTS 3

// Most propositional functions of a task.
#define GOODBOT_MOST_CONJUNCTS 4

// Most variables of a task.
#define GOODBOT_MOST_VARIABLES 6

// Most actions, doing nothing not counted.
#define GOODBOT_MOST_ACTIONS 15

// Most texts that `derived` returns for one object in one state.
#define GOODBOT_MOST_DERIVED 8

// In a table of steps: the action cannot be done there.
#define GOODBOT_CANNOT 65535

// The action of doing nothing, which every robot has.
#define GOODBOT_NOOP 15

// "Good bot."
#define GOODBOT_REWARD 1

// "Bad bot."
#define GOODBOT_PUNISH -1

// Silence.
#define GOODBOT_NEUTRAL 0

// The task that the robot follows is done here: the robot does nothing.
#define GOODBOT_PLAN_GOAL 0

// The action begins a shortest way to the goal.
#define GOODBOT_PLAN_TOWARD 1

// No goal can be reached any more: the robot does nothing.
#define GOODBOT_PLAN_DEAD_END 2

// The search was too small to tell: the robot does nothing.
#define GOODBOT_PLAN_UNKNOWN 3

// The action leads to the goal, but a shorter way may exist: feedback to it is no evidence for or against the task.
#define GOODBOT_PLAN_APPROXIMATE 4

// The evidence was used.
#define GOODBOT_EVIDENCE_USED 0

// It says nothing, because no task's right actions are known exactly in that state. The belief is unchanged.
#define GOODBOT_EVIDENCE_UNINFORMATIVE 1

// It is impossible whatever the task and the trainer, and was ignored.
#define GOODBOT_EVIDENCE_IMPOSSIBLE 2

// How many delays a word of feedback may have: 0, 1 or 2 actions.
#define GOODBOT_LAGS 3

// How many numbers of a strategy are about rests.
#define GOODBOT_RESTS 4

// Most strategies of `goodbot_trainers`; the capacity `STRATEGIES` may allow fewer.
#define GOODBOT_MOST_STRATEGIES 16

// Most transcripts of one command.
#define GOODBOT_MOST_HYPOTHESES 16

// Most bytes of a command that is heard in parts.
#define GOODBOT_MOST_COMMAND_BYTES 1024

// A meaning's weight is its probability, given the trainer's evidence and the words of the command.
#define GOODBOT_WEIGHTS_PAPER 0

// Its weight is the probability of its task.
#define GOODBOT_WEIGHTS_BELIEF 1

// Its weight comes from the trainer's evidence alone.
#define GOODBOT_WEIGHTS_EVIDENCE 2

// There is nothing to ask: act.
#define GOODBOT_ASK_NOTHING 0

// "Do you mean this room?", "this block?": answer `GOODBOT_YES` or `GOODBOT_NO`.
#define GOODBOT_ASK_OBJECT 1

// "Do you mean this kind of task?": answer `GOODBOT_YES` or `GOODBOT_NO`.
#define GOODBOT_ASK_KIND 2

// "Do you mean this task?": answer `GOODBOT_YES` or `GOODBOT_NO`.
#define GOODBOT_ASK_TASK 3

// "Which of these rooms, or of these blocks?": answer with the number of a choice, from 0 on, or `GOODBOT_NO` for none of these.
#define GOODBOT_ASK_WHICH_OBJECT 4

// "Which of these tasks?": answer with the number of a choice, from 0 on, or `GOODBOT_NO` for none of these.
#define GOODBOT_ASK_WHICH_TASK 5

// Yes.
#define GOODBOT_YES 0

// No, or none of these.
#define GOODBOT_NO -1

// There is no such place in the utterance.
#define GOODBOT_NOWHERE UINT32_MAX

// `goodbot_flash.write` is called for whole units of this many bytes, at multiples of it. The flash's own unit may be smaller, not larger.
#define GOODBOT_FLASH_UNIT 256

// The result of a call.
enum goodbot_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Done.
  GOODBOT_STATUS_OK = 0,
  // Not done yet: call again.
  GOODBOT_STATUS_WORKING = 1,
  // A pointer is null that must not be.
  GOODBOT_STATUS_NULL = 2,
  // This is no handle, or its memory was moved or overwritten.
  GOODBOT_STATUS_BAD_HANDLE = 3,
  // The memory is too small: ask for its size.
  GOODBOT_STATUS_MEMORY = 4,
  // The memory is not aligned to 8 bytes.
  GOODBOT_STATUS_ALIGNMENT = 5,
  // A text is not UTF-8, or longer than its call takes.
  GOODBOT_STATUS_TEXT = 6,
  // A table is full: `goodbot_full` says which.
  GOODBOT_STATUS_FULL = 7,
  // The home or table is described wrongly, or the call is for the other kind of robot.
  GOODBOT_STATUS_WORLD = 8,
  // There is no home yet: describe it and call `goodbot_home_build`.
  GOODBOT_STATUS_NO_WORLD = 9,
  // The command has no word.
  GOODBOT_STATUS_EMPTY_COMMAND = 10,
  // There is no task to do here.
  GOODBOT_STATUS_NO_TASK = 11,
  // No session is under way: hear a command first.
  GOODBOT_STATUS_NO_SESSION = 12,
  // The plan for this state is not done: call `goodbot_plan` until it is.
  GOODBOT_STATUS_NOT_PLANNED = 13,
  // The last session is still being learned from: call `goodbot_learn` until it is.
  GOODBOT_STATUS_STILL_LEARNING = 14,
  // The action cannot be done in this state.
  GOODBOT_STATUS_NOT_APPLICABLE = 15,
  // A number is not one of those allowed.
  GOODBOT_STATUS_NUMBER = 16,
  // There is no object or task of this name or number.
  GOODBOT_STATUS_UNKNOWN = 17,
  // The bytes are no model, or were damaged.
  GOODBOT_STATUS_BAD_MODEL = 18,
  // The model was learned with another machine vocabulary. A robot of the caller's own keeps its lessons if propositions and attributes are
  // only added, each at the end of its list.
  GOODBOT_STATUS_OTHER_DOMAIN = 19,
  // The buffer is too small.
  GOODBOT_STATUS_BUFFER = 20,
  // Anything else.
  GOODBOT_STATUS_OTHER = 21,
  // No action was done that could be judged: call `goodbot_acted` for each.
  GOODBOT_STATUS_NOTHING_DONE = 22,
  // The command is not heard to its end: call `goodbot_hear_on` until it is.
  GOODBOT_STATUS_STILL_HEARING = 23,
  // The session is not finished: call `goodbot_finish_on` until it is. A call that ends a session says so too, where the session is half
  // among those that were learned from.
  GOODBOT_STATUS_STILL_FINISHING = 24,
  // No question waits for an answer.
  GOODBOT_STATUS_NOT_ASKED = 25,
  // This is no answer to the question that was asked.
  GOODBOT_STATUS_NO_ANSWER = 26,
  // The flash refused, or did not keep what was written; the older model is still there.
  GOODBOT_STATUS_FLASH = 27,
  // Nothing is stored.
  GOODBOT_STATUS_NOTHING_STORED = 28,
  // A pause stopped the work: no session is under way.
  GOODBOT_STATUS_STOPPED = 29,
  // The text is no table of words: `docs/talk.md` says how one is written.
  GOODBOT_STATUS_CLOSED_WORDS = 30,
  // What was learned has changed since saving or restoring began: begin again.
  GOODBOT_STATUS_CHANGED = 31,
  // A model is coming back: call `goodbot_restore_on` until it is done.
  GOODBOT_STATUS_STILL_RESTORING = 32,
  // The library has no checks, and the table is none that was checked: print it by `goodbot table --c`, or link a library with the feature
  // `checks`. A task with a way needs them.
  GOODBOT_STATUS_UNCHECKED = 33,
  // Another call is using this robot: this one came from a function of the caller's, an interrupt or another thread. It did nothing.
  GOODBOT_STATUS_BUSY = 34,
  // The model has a format that is newer than this library: a newer program stored it. It is whole, so keep it.
  GOODBOT_STATUS_NEWER_FORMAT = 35,
  // A task's text is not of the form `name(?a, ?b) & other(?c)`: a bracket, a comma or a question mark is missing.
  GOODBOT_STATUS_TASK_FORM = 36,
  // A task's text names a propositional function that there is not.
  GOODBOT_STATUS_TASK_PROPOSITION = 37,
  // A task's text gives a propositional function more or fewer arguments than it has.
  GOODBOT_STATUS_TASK_ARGUMENTS = 38,
  // A task's text uses one variable for objects of two classes.
  GOODBOT_STATUS_TASK_CLASS = 39,
  // A task's way says what its goal says already, or avoids the goal; or the library has no `ways`.
  GOODBOT_STATUS_TASK_WAY = 40,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum goodbot_status goodbot_status;
#else
typedef int32_t goodbot_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What words ask the robot to do.
enum goodbot_said_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // A command: `goodbot_listen`.
  GOODBOT_SAID_KIND_COMMAND,
  // A word to the last step: `goodbot_feedback` with `GOODBOT_REWARD`.
  GOODBOT_SAID_KIND_GOOD,
  // The same with `GOODBOT_PUNISH`.
  GOODBOT_SAID_KIND_BAD,
  // Praise for a robot that rests at its goal: `goodbot_finish`.
  GOODBOT_SAID_KIND_FINISH,
  // The answer to the open question, which `answer` is given: `goodbot_answer`.
  GOODBOT_SAID_KIND_ANSWER,
  // Words that correct the robot on its way: `goodbot_correct`. A library without `talk` says so only of words that begin with a no, a not
  // or blame, or have a word such as "meant": they blame the robot.
  GOODBOT_SAID_KIND_CORRECTION,
  // The robot shall stop: `goodbot_forget`.
  GOODBOT_SAID_KIND_STOP,
  // Take something back.
  GOODBOT_SAID_KIND_UNDO,
  // The last command once more.
  GOODBOT_SAID_KIND_AGAIN,
  // There is nothing to do.
  GOODBOT_SAID_KIND_NOTHING,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum goodbot_said_kind goodbot_said_kind;
#else
typedef uint32_t goodbot_said_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The robot's verdict on an utterance.
enum goodbot_verdict
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // The task is meant: plan and act.
  GOODBOT_VERDICT_SURE,
  // It is not sure which task is meant: ask, or wait. `goodbot_forget` ends the session.
  GOODBOT_VERDICT_UNSURE,
  // The task is meant, and is done already.
  GOODBOT_VERDICT_DONE,
  // It means nothing that the robot can do here.
  GOODBOT_VERDICT_NONE,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum goodbot_verdict goodbot_verdict;
#else
typedef uint32_t goodbot_verdict;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The most likely reading of an utterance.
enum goodbot_taken_for
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // A command for one task.
  GOODBOT_TAKEN_FOR_COMMAND,
  // Nothing that the robot can do.
  GOODBOT_TAKEN_FOR_NOTHING,
  // A command about a thing that is not here.
  GOODBOT_TAKEN_FOR_ABSENT,
  // A thing, but not what to do with it.
  GOODBOT_TAKEN_FOR_ABOUT,
  // Something that shall not be: the session's tasks are negated.
  GOODBOT_TAKEN_FOR_NEGATED,
  // Perhaps the opposite of a command.
  GOODBOT_TAKEN_FOR_REVERSED,
  // Several commands: the session is about the first.
  GOODBOT_TAKEN_FOR_SEVERAL,
  // All things of a kind.
  GOODBOT_TAKEN_FOR_ALL,
  // The previous task once more.
  GOODBOT_TAKEN_FOR_AGAIN,
  // Praise, stop, a greeting and the like: `goodbot_said` says which.
  GOODBOT_TAKEN_FOR_TALK,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum goodbot_taken_for goodbot_taken_for;
#else
typedef uint32_t goodbot_taken_for;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The tables, by their positions in `goodbot_capacities`.
enum goodbot_capacity
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Objects of one environment: agent, rooms, doors and blocks together. At most 255; a home takes 32.
  GOODBOT_CAPACITY_OBJECTS,
  // Distinct names and attribute values of one environment.
  GOODBOT_CAPACITY_NAMES,
  // Bytes that the names and attribute values of one environment take together.
  GOODBOT_CAPACITY_NAME_BYTES,
  // Cells of a home that are not wall.
  GOODBOT_CAPACITY_CELLS,
  // Grounded tasks of one session. At most 64, one bit each in a task set.
  GOODBOT_CAPACITY_TASKS,
  // Trainer strategies told apart at once.
  GOODBOT_CAPACITY_STRATEGIES,
  // Joint beliefs: tasks times strategies.
  GOODBOT_CAPACITY_BELIEFS,
  // Distinct machine commands that one session's tasks and constraints can express.
  GOODBOT_CAPACITY_CANDIDATES,
  // Machine tokens of all candidates together.
  GOODBOT_CAPACITY_CANDIDATE_TOKENS,
  // Distinct ground propositions that one session's tasks are made of.
  GOODBOT_CAPACITY_GROUND_PROPOSITIONS,
  // Entries of the table that finds the tasks satisfied by a state: cells times movable pieces, the robot included.
  GOODBOT_CAPACITY_GOAL_ENTRIES,
  // States that one search can hold that expands them one by one, where actions cost 1 each and are at most 8.
  GOODBOT_CAPACITY_STATES,
  // States that one search can hold if the state space is larger than `STATES`: visited states are then hashed. 0 turns it off.
  GOODBOT_CAPACITY_HASHED_STATES,
  // Distinct English words. At most 65,534.
  GOODBOT_CAPACITY_WORDS,
  // Bytes that those words take together.
  GOODBOT_CAPACITY_WORD_BYTES,
  // Distinct machine tokens. At most 65,534.
  GOODBOT_CAPACITY_TOKENS,
  // Bytes that those tokens take together.
  GOODBOT_CAPACITY_TOKEN_BYTES,
  // Distinct machine commands in the training data.
  GOODBOT_CAPACITY_COMMANDS,
  // Machine tokens of those commands together.
  GOODBOT_CAPACITY_COMMAND_TOKENS,
  // Sessions learned from.
  GOODBOT_CAPACITY_SESSIONS,
  // English words of those sessions' commands together.
  GOODBOT_CAPACITY_SENTENCE_WORDS,
  // Weighted pairs of an English command and a machine command in the training data.
  GOODBOT_CAPACITY_PAIRS,
  // Cells of the translation table: (machine tokens + 1) times English words.
  GOODBOT_CAPACITY_TRANSLATIONS,
  // Cells of all alignment tables together: (l + 1) times n for each pair of lengths.
  GOODBOT_CAPACITY_ALIGNMENTS,
  // Distinct pairs of a machine command's and an English command's length.
  GOODBOT_CAPACITY_LENGTH_PAIRS,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum goodbot_capacity goodbot_capacity;
#else
typedef uint8_t goodbot_capacity;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A robot. Its memory is the caller's and must not be moved, copied over or freed while it is used.
typedef struct goodbot goodbot;

// The size of each table, one number for each `goodbot_capacity`. Begin with a preset and raise the sizes of full tables.
typedef struct goodbot_capacities {
  // Entries of each table.
  uint32_t entries[GOODBOT_CAPACITIES];
} goodbot_capacities;

// The lessons that a robot shall keep without forgetting any.
typedef struct goodbot_lessons {
  // How many sessions.
  uint32_t sessions;
  // The most words of one command, at most 64.
  uint32_t words_per_command;
  // How many different words the commands have together.
  uint32_t different_words;
  // Bytes that those words take together.
  uint32_t word_bytes;
} goodbot_lessons;

// A thing and the cell where it was sensed.
typedef struct goodbot_sensed {
  // The robot's own name or a block's.
  const char *name;
  // The cell's column.
  int32_t x;
  // The cell's row.
  int32_t y;
} goodbot_sensed;

// A class that carries an attribute, and the prefix of the capitalised value: `roomIs` makes `roomIsRed`.
typedef struct goodbot_carrier {
  // The class, by position.
  uint8_t object_class;
  // The prefix.
  const char *prefix;
} goodbot_carrier;

// An attribute, such as colour.
typedef struct goodbot_attribute {
  // The name.
  const char *name;
  // The classes that carry it.
  const struct goodbot_carrier *carriers;
  // How many.
  uint32_t carrier_count;
} goodbot_attribute;

// A propositional function, such as `blockInRoom`.
typedef struct goodbot_proposition {
  // The name.
  const char *name;
  // The class of each argument, by position.
  uint8_t parameters[GOODBOT_MOST_ARGUMENTS];
  // How many arguments, one at least.
  uint32_t parameter_count;
} goodbot_proposition;

// An object.
typedef struct goodbot_object {
  // The class, by position.
  uint8_t object_class;
  // The name.
  const char *name;
  // The value of each attribute, in the order of the attributes; null for none.
  const char *values[GOODBOT_MOST_ATTRIBUTES];
} goodbot_object;

// An action.
typedef struct goodbot_action {
  // The name.
  const char *name;
  // The cost, 1 to 16.
  uint32_t cost;
} goodbot_action;

// Sets `next` to the state that an action leads to and returns true, or returns false if the action cannot be done. It must always answer
// the same, and must not call goodbot.
typedef bool (*goodbot_step)(void *context, uint32_t state, uint8_t action, uint32_t *next);

// Whether a proposition, by position, holds of the objects, by position, in a state. It must always answer the same, and must not call
// goodbot.
typedef bool (*goodbot_holds)(void *context,
                              uint32_t state,
                              uint8_t proposition,
                              const uint8_t *arguments);

// Returns a derived fact about an object, by position, in a state, such as `leftmost`: the text with this number, counted from 0, or
// null if there are no more. It must always answer the same, and must not call goodbot. Each text must stay until the function is called
// again.
typedef const char *(*goodbot_derived)(void *context,
                                       uint32_t state,
                                       uint8_t object,
                                       uint32_t number);

// A kind of task, parsed by `goodbot table --c`: a library without the feature `checks` parses no texts of tasks.
typedef struct goodbot_kind {
  // The class of each variable, by position.
  uint8_t classes[GOODBOT_MOST_VARIABLES];
  // How many.
  uint8_t class_count;
  // The propositional functions that are to hold, by position.
  uint8_t propositions[GOODBOT_MOST_CONJUNCTS];
  // How many.
  uint8_t proposition_count;
  // The variables of each propositional function, by position.
  uint8_t variables[GOODBOT_MOST_CONJUNCTS][GOODBOT_MOST_ARGUMENTS];
} goodbot_kind;

// A robot of the caller's own.
typedef struct goodbot_table {
  // The names of the classes.
  const char *const *classes;
  // How many.
  uint32_t class_count;
  // The attributes; may be null if there is none.
  const struct goodbot_attribute *attributes;
  // How many.
  uint32_t attribute_count;
  // The propositional functions.
  const struct goodbot_proposition *propositions;
  // How many.
  uint32_t proposition_count;
  // The objects.
  const struct goodbot_object *objects;
  // How many.
  uint32_t object_count;
  // The actions.
  const struct goodbot_action *actions;
  // How many.
  uint32_t action_count;
  // The tasks that commands may mean, such as `blockInRoom(?o, ?r)`.
  const char *const *tasks;
  // How many, one at least.
  uint32_t task_count;
  // How many states there are, one at least. They are numbered from 0.
  uint32_t state_count;
  // The first state.
  uint32_t start;
  // The state that each action leads to from each state, `next[state * action_count + action]`, or `GOODBOT_CANNOT`. Null if `step` is
  // given.
  const uint16_t *next;
  // What an action leads to, if there is no table of steps.
  goodbot_step step;
  // Which propositions hold.
  goodbot_holds holds;
  // Derived facts about objects; null for none.
  goodbot_derived derived;
  // Handed to all functions.
  void *context;
  // The tasks once more, parsed by `goodbot table --c`, in a table that it has checked; else null. A library with the feature `checks`
  // parses and checks everything itself.
  const struct goodbot_kind *kinds;
} goodbot_table;

// A way to reward and punish, for `goodbot_trainers`.
typedef struct goodbot_strategy {
  // The probability of silence after a right action.
  float mu_plus;
  // The probability of silence after a wrong action.
  float mu_minus;
  // The probability of taking one for the other.
  float epsilon;
  // The probability that a word is about the last action, the one before, and the one before that: 1, 0 and 0 where no word is late.
  float lags[GOODBOT_LAGS];
  // Feedback to rests: the probability of silence after a rest at the goal, and after one elsewhere, that of taking one for the other,
  // and how far a move inside the goal counts as a rest there. A trainer who judges rests like moves has `mu_plus`, `mu_minus`,
  // `epsilon` and 0.
  float rests[GOODBOT_RESTS];
  // The prior probability that the trainer is like this, in any unit.
  float prior;
} goodbot_strategy;

// One entry of a speech recogniser's n-best list.
typedef struct goodbot_hypothesis {
  // The command, in UTF-8.
  const char *command;
  // The recogniser's probability of it, in any unit: a number of 0 or more. For `goodbot_hear_one_of_logs` its natural logarithm.
  float weight;
} goodbot_hypothesis;

// How probable it is that the trainer ends the session after an action, at every moment from 0 to less than 1.
typedef struct goodbot_hazard {
  // After a move, where nothing was said in the session.
  float moved;
  // After a rest that follows a move, where nothing was said.
  float rested;
  // After a later rest in a row, where nothing was said.
  float resting;
  // The factor if the last word was "good bot".
  float praised;
  // The factor if the last word was "bad bot".
  float scolded;
} goodbot_hazard;

// How a robot takes evidence and acts: `goodbot_current_options` gives it, `goodbot_set_options` takes it.
typedef struct goodbot_options {
  // Among the actions that lead on, choose the one whose feedback says most about the task; otherwise any of them.
  bool telling;
  // The share of the belief about the trainer that is forgotten at each new command, from 0 to 1.
  float drift;
  // How probable it is that the trainer ends the session after an action where the task is done.
  struct goodbot_hazard ends_at_goal;
  // The same after an action where it is not done. If both are equal, `goodbot_trainer_ended` is no evidence.
  struct goodbot_hazard ends_elsewhere;
  // The weight of each meaning of a command in learning: `GOODBOT_WEIGHTS_PAPER`, `GOODBOT_WEIGHTS_BELIEF` or
  // `GOODBOT_WEIGHTS_EVIDENCE`.
  uint32_t weights;
  // Weights up to this are not learned; from 0 to less than 1.
  float least_weight;
  // The share of each kind of task that goes to tasks that hold already, from 0 to less than 1: the robot rests for these. 0.08 in a
  // new robot, as in people's talk. With 0 it never takes a command for what holds, so it undoes what it is told is so already.
  float done;
} goodbot_options;

// The caller's function, called between two parts of listening; false stops it.
typedef bool (*goodbot_pause)(void *context);

// The robot's reading of an utterance.
typedef struct goodbot_listened {
  // The tasks that are meant, one bit each by their positions; several if all things of a kind are meant.
  uint64_t tasks;
  // What to do.
  goodbot_verdict verdict;
  // The reading.
  goodbot_taken_for taken_for;
  // The most likely task, by its position.
  uint32_t task;
  // How probable it is that the tasks are meant, from 0 to 1.
  float probability;
  // How probable it is that one of the session's tasks is meant, from 0 to 1.
  float command;
  // The least `probability` for the verdict `SURE`.
  float sure;
  // Where the rest of several commands begins, in bytes: `goodbot_listen_on` takes it when the first is done. `GOODBOT_NOWHERE`
  // without a rest.
  uint32_t rest;
  // Where the unread words begin, in bytes: those after the 64th. `GOODBOT_NOWHERE` if all were read.
  uint32_t unread;
} goodbot_listened;

// The progress of saving a model in parts, in memory of yours that stays in place: `goodbot_begin_saving`.
typedef struct goodbot_saving {
  // Not to be touched.
  size_t opaque[16];
} goodbot_saving;

// The progress of restoring a model in parts, in memory of yours that stays in place: `goodbot_begin_restoring`.
typedef struct goodbot_restoring {
  // Not to be touched.
  size_t opaque[80];
} goodbot_restoring;

// A flash of the caller's: two slots, one after the other. Each function returns false if the flash refuses, and must not call goodbot.
typedef struct goodbot_flash {
  // Handed to each function.
  void *context;
  // Reads `bytes` bytes from `at` on.
  bool (*read)(void *context, uint32_t at, uint8_t *to, uint32_t bytes);
  // Writes `bytes` bytes from `at` on, where all is erased.
  bool (*write)(void *context, uint32_t at, const uint8_t *from, uint32_t bytes);
  // Erases one slot: `bytes` bytes from `at` on.
  bool (*erase)(void *context, uint32_t at, uint32_t bytes);
  // The address of the first slot: a multiple of the flash's erase size, and of `GOODBOT_FLASH_UNIT`.
  uint32_t start;
  // Bytes of each slot: a multiple of the same sizes, and at least `GOODBOT_FLASH_UNIT` more than the model.
  uint32_t slot_bytes;
} goodbot_flash;

// The progress of storing a model in parts, in memory of yours that stays in place: `goodbot_begin_storing`.
typedef struct goodbot_storing {
  // Not to be touched.
  size_t opaque[32];
} goodbot_storing;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// What is wrong, as a sentence for people; a constant text that is never null.
GOODBOT_MUST_USE const char *goodbot_status_text(int32_t status);

// The version of the library that is linked: compare it with `GOODBOT_API_VERSION`.
GOODBOT_MUST_USE uint32_t goodbot_api_version(void);

// Fills in a preset: `GOODBOT_SMALL`, `GOODBOT_TINY`, `GOODBOT_OWN` or `GOODBOT_STANDARD`.
//
// The caller sees to it:
// `capacities` is null or points to memory for it.
GOODBOT_MUST_USE
goodbot_status goodbot_preset(uint32_t preset,
                              struct goodbot_capacities *capacities);

// Bytes that a robot in a home takes with these capacities; 0 for null.
//
// The caller sees to it:
// `capacities` is null or points to capacities.
GOODBOT_MUST_USE size_t goodbot_size(const struct goodbot_capacities *capacities);

// Bytes that a robot of the caller's own takes with these capacities; 0 for null.
//
// The caller sees to it:
// `capacities` is null or points to capacities.
GOODBOT_MUST_USE size_t goodbot_table_size(const struct goodbot_capacities *capacities);

// The least capacities with which a robot like this one, in its present world, takes such lessons and forgets none. Ask a robot with ample
// memory, on a host: `FULL` if its own is too small for one session. A session under way ends unlearned.
//
// With these `STATES`, every plan is exact. A home can do with fewer; its plans to far goals are then approximate. `HASHED_STATES` and
// `GOAL_ENTRIES` are 0: no robot needs them; goal entries save time.
//
// The caller sees to it:
// `robot` is null or a handle, `lessons` null or points to lessons, `capacities` is null or points to memory for it.
GOODBOT_MUST_USE
goodbot_status goodbot_least_capacities(struct goodbot *robot,
                                        const struct goodbot_lessons *lessons,
                                        struct goodbot_capacities *capacities);

// The capacities that the robot needed so far: with them, another robot has room for the same sessions. Give a robot with
// `GOODBOT_STANDARD` its lessons on a host; these are then the capacities for the controller. `GOAL_ENTRIES` is 0: goal entries only save
// time, in homes.
//
// The caller sees to it:
// `robot` is null or a handle, `capacities` null or points to memory for it.
GOODBOT_MUST_USE
goodbot_status goodbot_usage(struct goodbot *robot,
                             struct goodbot_capacities *capacities);

// How many sessions it has learned from and still keeps.
//
// The caller sees to it:
// `robot` is null or a handle, `count` null or room for a number.
GOODBOT_MUST_USE goodbot_status goodbot_session_count(const struct goodbot *robot, uint32_t *count);

// Begins the robot's own random choices anew: the same seed, the same choices.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE goodbot_status goodbot_seed(struct goodbot *robot, uint64_t seed);

// The table that was full last, after `FULL` or after a session gave way. `name` receives its name (cut to `bytes` with its 0), `limit`
// the entries that it holds, and `given` the entries that were needed. `UNKNOWN` if none was full.
//
// The caller sees to it:
// `robot` is null or a handle; `name` is room for `bytes` bytes; the others are room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_full(const struct goodbot *robot,
                            char *name,
                            size_t bytes,
                            uint32_t *limit,
                            uint32_t *given);

// Makes a robot that will live in homes, in the caller's memory: `bytes` bytes, aligned to 8, as many as `goodbot_size` says. It
// understands commands to go to a room and to bring a block to a room.
//
// The caller sees to it:
// `memory` is null, or the caller's memory for the robot alone, which does not move; `capacities` and `robot` are null or valid.
GOODBOT_MUST_USE
goodbot_status goodbot_init_home(void *memory,
                                 size_t bytes,
                                 const struct goodbot_capacities *capacities,
                                 struct goodbot **robot);

// As `goodbot_init_home`, for commands that may mean tasks of these kinds, `GOODBOT_MOST_TASKS` at most: `agentInRoom(?a, ?goal)`,
// `blockInRoom(?o, ?r)`, or with a way, `agentInRoom(?a, ?goal) avoiding agentInRoom(?a, ?not)`, `... through agentInRoom(?a, ?via)`,
// `... through agentInRoom(?a, ?via) or agentInRoom(?a, ?other)`. Where a text is no kind of task, `TASK_FORM` and the four after it say why;
// `NUMBER` if there is no text or too many. The texts are not needed afterwards.
//
// The caller sees to it:
// As for `goodbot_init_home`; `tasks` is null or points to `task_count` texts, each null or ended by a 0.
GOODBOT_MUST_USE
goodbot_status goodbot_init_home_tasks(void *memory,
                                       size_t bytes,
                                       const struct goodbot_capacities *capacities,
                                       const char *const *tasks,
                                       uint32_t task_count,
                                       struct goodbot **robot);

// Begins to describe a home. What was learned stays; a session under way ends unlearned.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE goodbot_status goodbot_home_begin(struct goodbot *robot);

// Adds a room: the box of its border, whose cells are wall where no door is, and its colour.
//
// The caller sees to it:
// `robot` is null or a handle; the texts are null or C strings.
GOODBOT_MUST_USE
goodbot_status goodbot_home_room(struct goodbot *robot,
                                 const char *name,
                                 int32_t left,
                                 int32_t bottom,
                                 int32_t right,
                                 int32_t top,
                                 const char *color);

// Adds a door: a box of cells without walls.
//
// The caller sees to it:
// As `goodbot_home_room`.
GOODBOT_MUST_USE
goodbot_status goodbot_home_door(struct goodbot *robot,
                                 const char *name,
                                 int32_t left,
                                 int32_t bottom,
                                 int32_t right,
                                 int32_t top);

// Adds a block.
//
// The caller sees to it:
// As `goodbot_home_room`.
GOODBOT_MUST_USE
goodbot_status goodbot_home_block(struct goodbot *robot,
                                  const char *name,
                                  int32_t x,
                                  int32_t y,
                                  const char *color,
                                  const char *shape);

// Adds the robot itself.
//
// The caller sees to it:
// As `goodbot_home_room`.
GOODBOT_MUST_USE
goodbot_status goodbot_home_agent(struct goodbot *robot,
                                  const char *name,
                                  int32_t x,
                                  int32_t y);

// Finds the free cells of the home, at most `budget` in a call, so that a control loop goes on while a large home is built. `WORKING` means: call
// again. Once it is done, `goodbot_home_build` is short. Adding an object starts it anew.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_home_find_cells(struct goodbot *robot,
                                       uint32_t budget);

// Checks the whole home. Actions 0 to 3 are then north, south, east and west; a block in the way is pushed. If it fails, begin the
// description again.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_home_build(struct goodbot *robot);

// Sets whether words may mean derived facts, as well as colours and shapes: the `leftmost`, `rightmost`, `topmost`, `bottommost`,
// `largest` or `smallest` room, the `nearest` or `farthest` room or block. It holds for this home, once it is built; the next home begins
// without. A session under way ends unlearned; one that joins the others already goes on first (`STILL_FINISHING`). One model can have
// lessons with derived facts and lessons without.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_home_derived(struct goodbot *robot,
                                    bool derived);

// Says where the robot itself or a block is, as sensed.
//
// The caller sees to it:
// As `goodbot_home_room`.
GOODBOT_MUST_USE
goodbot_status goodbot_home_place(struct goodbot *robot,
                                  const char *name,
                                  int32_t x,
                                  int32_t y);

// Says where the robot itself and blocks are, all at once, as sensed, so that two of them can change places. Things that are not named
// stay. `UNKNOWN` if a name is that of nothing that moves, `NUMBER` if a cell is wall or two things are in one cell; nothing changes then.
//
// The caller sees to it:
// `robot` is null or a handle; `sensed` is null or points to `count` of them; the names are null or C strings.
GOODBOT_MUST_USE
goodbot_status goodbot_home_sense(struct goodbot *robot,
                                  const struct goodbot_sensed *sensed,
                                  uint32_t count);

// Where the robot itself or a block is.
//
// The caller sees to it:
// As `goodbot_home_room`; `x` and `y` are null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_home_where(const struct goodbot *robot,
                                  const char *name,
                                  int32_t *x,
                                  int32_t *y);

// Makes a robot of the caller's own, in the caller's memory: `bytes` bytes, aligned to 8, as many as `goodbot_table_size` says. The
// description and all that it points to must stay as long as the robot is used.
//
// The caller sees to it:
// `memory` is null, or the caller's memory for the robot alone, which does not move; the other pointers are null or valid.
GOODBOT_MUST_USE
goodbot_status goodbot_init_table(void *memory,
                                  size_t bytes,
                                  const struct goodbot_capacities *capacities,
                                  const struct goodbot_table *table,
                                  struct goodbot **robot);

// Like `goodbot_init_table`, in the same memory, but also writes the fault of the description, with a 0 at its end: the list, the
// item's position, the field, its value and the allowed values; or the full table, its size and the size needed. The text is empty if there
// is no fault. Returns the status of `goodbot_init_table`, or `BUFFER` if the text does not fit; 200 bytes are enough.
//
// The caller sees to it:
// As `goodbot_init_table`; `text` is null or room for `text_bytes` bytes.
GOODBOT_MUST_USE
goodbot_status goodbot_explain_table(void *memory,
                                     size_t bytes,
                                     const struct goodbot_capacities *capacities,
                                     const struct goodbot_table *table,
                                     char *text,
                                     size_t text_bytes);

// Sets the current state, as sensed.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE goodbot_status goodbot_table_set_state(struct goodbot *robot, uint32_t state);

// The current state.
//
// The caller sees to it:
// `robot` is null or a handle, `state` null or room for a number.
GOODBOT_MUST_USE goodbot_status goodbot_table_state(const struct goodbot *robot, uint32_t *state);

// Sets how the trainer rewards and punishes: the probability of silence after a right action and after a wrong one, and of taking one for
// the other. Without this the robot expects a trainer who uses both words (0.7, 0.7 and 0.1), praise alone (0.05, 0.7 and 0.1) or blame
// alone (0.7, 0.05 and 0.1), and finds out which; with fewer than 3 `STRATEGIES`, or fewer `BELIEFS` than 3 times `TASKS`, as in the tiny
// preset, only the first. A session under way ends unlearned; one that joins the others already goes on first (`STILL_FINISHING`).
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_trainer(struct goodbot *robot,
                               float mu_plus,
                               float mu_minus,
                               float epsilon);

// Sets the `count` strategies that the trainer may have; the robot finds out which. A session under way ends unlearned; one that joins the
// others already goes on first (`STILL_FINISHING`). `FULL` if they are more than the capacity `STRATEGIES`, `NUMBER` if there are none, a
// number is out of range, or all priors are 0; the strategies are then unchanged.
//
// The caller sees to it:
// `robot` is null or a handle, `strategies` null or points to `count` of them.
GOODBOT_MUST_USE
goodbot_status goodbot_trainers(struct goodbot *robot,
                                const struct goodbot_strategy *strategies,
                                uint32_t count);

// Hears a command: a session begins in the current state.
//
// The caller sees to it:
// `robot` is null or a handle, `command` null or a C string in UTF-8.
GOODBOT_MUST_USE goodbot_status goodbot_hear(struct goodbot *robot, const char *command);

// Hears the most probable of `count` transcripts of one command, by its weight and its possible meanings here. `chosen` receives its
// position, and the session is as if only that one had been heard. It takes the time of hearing each transcript, and one of them twice.
//
// The caller sees to it:
// `robot` is null or a handle; `hypotheses` is null or points to `count` of them; the commands are null or C strings; `chosen` is null or
// room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_hear_one_of(struct goodbot *robot,
                                   const struct goodbot_hypothesis *hypotheses,
                                   uint32_t count,
                                   uint32_t *chosen);

// As `goodbot_hear_one_of`, where each weight is the natural logarithm of a probability, as many recognisers give it: any number, because
// only differences count, or negative infinity for 0. Multiply acoustic scores by the recogniser's acoustic scale first, often 0.1.
//
// The caller sees to it:
// As `goodbot_hear_one_of`.
GOODBOT_MUST_USE
goodbot_status goodbot_hear_one_of_logs(struct goodbot *robot,
                                        const struct goodbot_hypothesis *hypotheses,
                                        uint32_t count,
                                        uint32_t *chosen);

// Begins to hear a command as `goodbot_hear` does, but in parts: call `goodbot_hear_on` until it is done. The command is copied; one with
// more than `GOODBOT_MOST_COMMAND_BYTES` is refused with `TEXT`. `goodbot_hear_on` tells that it has no word, too many, or one that is too
// long. The tasks are known after its first call.
//
// The caller sees to it:
// `robot` is null or a handle, `command` null or a C string in UTF-8.
GOODBOT_MUST_USE
goodbot_status goodbot_begin_hearing(struct goodbot *robot,
                                     const char *command);

// Hears the last command again, in the state in which the session began: the belief goes on. This also takes up an ended session, learned
// from or forgotten; `NO_SESSION` if the last one began in another state.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_hear_again(struct goodbot *robot);

// Goes on hearing the command, at most about `budget` table cells of work. `WORKING` means: call again.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_hear_on(struct goodbot *robot,
                               uint32_t budget);

// Plans for the current state, with at most about `budget` node expansions. `WORKING` means: call again.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_plan(struct goodbot *robot,
                            uint32_t budget);

// Decides on an action in the current state, for which the plan must be done. `plan` may be null; it receives `GOODBOT_PLAN_GOAL` and so
// on.
//
// The caller sees to it:
// `robot` is null or a handle; `action` is room for one, `plan` is null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_decide(struct goodbot *robot,
                              uint8_t *action,
                              uint32_t *plan);

// Takes in the trainer's feedback to the action that was done last (see `goodbot_acted`): `GOODBOT_REWARD`, `GOODBOT_PUNISH` or
// `GOODBOT_NEUTRAL`, if nothing was said to it: that silence says something, too. It may be called at any time until the next action is
// done, also while the robot plans; of several words the last counts. If it is not called, the action is no evidence. `evidence` receives
// `GOODBOT_EVIDENCE_USED` and so on.
//
// The caller sees to it:
// `robot` is null or a handle, `evidence` null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_feedback(struct goodbot *robot,
                                int32_t feedback,
                                uint32_t *evidence);

// A remark for whoever writes the program: `text` receives a constant text, which is empty if there is none. There is one if words were told,
// but nothing of eight actions or more, and silence never: a trainer with one button says something by not pressing it.
//
// The caller sees to it:
// `robot` is null or a handle, `text` null or room for a pointer.
GOODBOT_MUST_USE
goodbot_status goodbot_remark(const struct goodbot *robot,
                              const char **text);

// Takes in that the trainer ended the session in the current state, whose plan must be done, before `goodbot_finish`: people end a session
// more often where the task is done (`ends_at_goal` and `ends_elsewhere` of the options). `evidence` receives `GOODBOT_EVIDENCE_USED` and so on.
//
// The caller sees to it:
// `robot` is null or a handle, `evidence` null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_trainer_ended(struct goodbot *robot,
                                     uint32_t *evidence);

// Takes in an action that the trainer did to show the way, and applies it to the current state as `goodbot_acted` does. `evidence` receives
// `GOODBOT_EVIDENCE_USED` and so on.
//
// The caller sees to it:
// `robot` is null or a handle, `evidence` null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_demonstration(struct goodbot *robot,
                                     uint8_t action,
                                     uint32_t *evidence);

// Records that an action was done in the current state, for which the plan must be done, and had the effect that the description says. A
// robot with sensors calls this after each action too, and then reports the places that differ.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_acted(struct goodbot *robot,
                             uint8_t action);

// Ends the session and begins to learn from it: call `goodbot_learn` until it is done. `gave_way` is null, or receives the number of older
// sessions that were forgotten because memory was full; `goodbot_full` then names the table to raise.
//
// The caller sees to it:
// `robot` is null or a handle, `gave_way` null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_finish(struct goodbot *robot,
                              uint32_t *gave_way);

// Begins to end the session as `goodbot_finish` does, but in parts: call `goodbot_finish_on` until it is done.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_begin_finishing(struct goodbot *robot);

// Goes on ending the session, at most about `budget` table cells of work. `WORKING` means: call again. Once it is done, `gave_way` is
// set as by `goodbot_finish`.
//
// The caller sees to it:
// `robot` is null or a handle, `gave_way` null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_finish_on(struct goodbot *robot,
                                 uint32_t budget,
                                 uint32_t *gave_way);

// Ends the session without learning from it. It may be called at any time: "stop". `STILL_FINISHING` where it comes too late, because
// `goodbot_finish_on` has begun to put the session among the others: go on with that.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_forget(struct goodbot *robot);

// Goes on learning, at most about `budget` table cells of work. `WORKING` means: call again.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE goodbot_status goodbot_learn(struct goodbot *robot, uint32_t budget);

// Reads the robot's options, to be changed and handed to `goodbot_set_options`.
//
// The caller sees to it:
// `robot` is null or a handle, `options` null or room for them.
GOODBOT_MUST_USE
goodbot_status goodbot_current_options(const struct goodbot *robot,
                                       struct goodbot_options *options);

// Sets the robot's options. The training data stay; a session under way ends unlearned; one that joins the others already goes on first
// (`STILL_FINISHING`). `NUMBER` if one is out of range: the options are then unchanged.
//
// The caller sees to it:
// `robot` is null or a handle, `options` null or points to them.
GOODBOT_MUST_USE
goodbot_status goodbot_set_options(struct goodbot *robot,
                                   const struct goodbot_options *options);

// How many tasks the command may mean.
//
// The caller sees to it:
// `robot` is null or a handle, `count` null or room for a number.
GOODBOT_MUST_USE goodbot_status goodbot_task_count(const struct goodbot *robot, uint32_t *count);

// How probable a task is.
//
// The caller sees to it:
// `robot` is null or a handle, `probability` null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_task_probability(const struct goodbot *robot,
                                        uint32_t task,
                                        float *probability);

// The most likely task.
//
// The caller sees to it:
// `robot` is null or a handle, `task` null or room for a number.
GOODBOT_MUST_USE goodbot_status goodbot_most_likely(struct goodbot *robot, uint32_t *task);

// Writes a task as text, such as `blockInRoom(block0,room1)` or, with a way, `agentInRoom(agent0,room1) avoiding agentInRoom(agent0,room2)`,
// with a 0 at its end. `BUFFER` where it does not fit.
//
// The caller sees to it:
// `robot` is null or a handle; `buffer` is null or room for `bytes` bytes.
GOODBOT_MUST_USE
goodbot_status goodbot_task_text(const struct goodbot *robot,
                                 uint32_t task,
                                 char *buffer,
                                 size_t bytes);

// Reads the last command for `goodbot_explain_word`, if this task is meant, at most about `budget` table cells of work. `WORKING` means: call
// again; the robot may plan and act meanwhile. A command that was heard since, another task, and the end of the session begin it anew.
// `UNKNOWN` for no task.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_explain_on(struct goodbot *robot,
                                  uint32_t task,
                                  uint32_t budget);

// Explains a word of the last command, if this task is meant. `position` counts the words from 0; `rank` 0 is the word's most probable
// meaning, 1 the next, and so on. `UNKNOWN` beyond the last word or the last meaning, or for no task. `word` receives the word, empty if
// the robot has no room for it. `meaning` receives the role and the value, such as `goal of agentInRoom: colorGreen`, or `kind of task`,
// `no meaning`, or `never heard`, which is then the only meaning. `share` receives the share of the meaning: the shares of one word add
// up to 1; a word that was never heard has 0. Each text has a 0 at its end; `BUFFER` if one does not fit. It reads the command first, at
// once, unless `goodbot_explain_on` has done so for this task.
//
// The caller sees to it:
// `robot` is null or a handle; `word` and `meaning` are null or room for that many bytes; `share` is null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_explain_word(struct goodbot *robot,
                                    uint32_t task,
                                    uint32_t position,
                                    uint32_t rank,
                                    char *word,
                                    size_t word_bytes,
                                    char *meaning,
                                    size_t meaning_bytes,
                                    float *share);

// Proposes a question if it teaches more than acting. The plan for the current state must be done. `kappa` is the cost of a question, in
// steps (8 is a good number, infinite: never ask), and `eta` the probability of a wrong answer (0.05). It looks ahead with at most about
// `budget` node expansions; `WORKING` means: call again. `kind` receives `GOODBOT_ASK_NOTHING` and so on, and `choices` the number of
// choices, 1 for yes or no. A question may stay unanswered. It is not asked again in this session, and after eight questions no more
// are asked.
//
// The caller sees to it:
// `robot` is null or a handle; `kind` and `choices` are null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_question(struct goodbot *robot,
                                float kappa,
                                float eta,
                                uint32_t budget,
                                uint32_t *kind,
                                uint32_t *choices);

// Writes the text of one choice of the open question, with a 0 at its end: the name of an object such as `room1`, a task such as
// `blockInRoom(block0,room1)`, or a kind of task such as `blockInRoom`. `BUFFER` if it does not fit, `NOT_ASKED` without an open question.
//
// The caller sees to it:
// `robot` is null or a handle; `buffer` is null or room for `bytes` bytes.
GOODBOT_MUST_USE
goodbot_status goodbot_question_text(const struct goodbot *robot,
                                     uint32_t choice,
                                     char *buffer,
                                     size_t bytes);

// Takes in the trainer's answer to the open question: `GOODBOT_YES`, `GOODBOT_NO`, or the number of a choice, from 0 on. `NOT_ASKED`
// without an open question, `NO_ANSWER` if this is no answer to it; the question then stays open. `evidence` receives
// `GOODBOT_EVIDENCE_USED` and so on.
//
// The caller sees to it:
// `robot` is null or a handle, `evidence` null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_answer(struct goodbot *robot,
                              int32_t answer,
                              uint32_t *evidence);

// Finds what a person's words ask for, given the session under way, the actions that `goodbot_acted` reported, and the open question. It
// only says so: the caller does it. No lesson is needed, and no button. `answer` receives the answer for `goodbot_answer`, if the words are
// one. `closed_words` is the table of the language that is spoken (`docs/talk.md`). Without it, if it is null, "stop", "halt" and "emergency
// stop" stop the robot, and everything else is a command, also praise and blame; the call is then short, so a control loop may look for
// "stop" at any moment. The function is in a library with the feature `voice`, as in the packages for boards.
//
// The caller sees to it:
// `robot` is null or a handle; the texts are null or C strings; `said` and `answer` are null or room for one.
GOODBOT_MUST_USE
goodbot_status goodbot_said(const struct goodbot *robot,
                            const char *words,
                            const char *closed_words,
                            goodbot_said_kind *said,
                            int32_t *answer);

// The functions from here to `goodbot_correct` are in a library with the feature `talk`. The packages for boards have none of them.
//
// Hears an utterance that may be no command, in the current state, and finds its reading. A session begins as with `goodbot_hear`; unless
// the verdict is `SURE`, ask or wait. A robot with few lessons is seldom sure.
//
// `closed_words` is a table of words such as "not", "and", "stop", in the language that is spoken (`docs/talk.md`), or null: a robot
// without one asks back more often. `CLOSED_WORDS` if it is no such table. `pause` is null, or is called after each part of the work, with
// `context`: it must not use this robot, and returns whether to go on. If it returns false, the status is `STOPPED`, and no session is
// under way.
//
// The caller sees to it:
// `robot` is null or a handle; the texts are null or C strings; `listened` is null or room for one.
GOODBOT_MUST_USE
goodbot_status goodbot_listen(struct goodbot *robot,
                              const char *utterance,
                              const char *closed_words,
                              goodbot_pause pause,
                              void *context,
                              struct goodbot_listened *listened);

// As `goodbot_listen`, for the rest of an utterance of several commands, when the previous command is done and its session over: `rest` is
// the utterance from `goodbot_listened.rest` on. It may leave out a word that the previous command has.
//
// The caller sees to it:
// As `goodbot_listen`.
GOODBOT_MUST_USE
goodbot_status goodbot_listen_on(struct goodbot *robot,
                                 const char *rest,
                                 const char *closed_words,
                                 goodbot_pause pause,
                                 void *context,
                                 struct goodbot_listened *listened);

// Remembers that the robot followed a task of the session, by its position: `goodbot_listen` then knows what "it", "there", "back", "the
// other one" and "again" mean. Call it before the session is finished or forgotten.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE
goodbot_status goodbot_remember(struct goodbot *robot,
                                uint32_t task);

// Begins another conversation: the previous one is forgotten.
//
// The caller sees to it:
// `robot` is null or a handle.
GOODBOT_MUST_USE goodbot_status goodbot_converse_anew(struct goodbot *robot);

// Takes in words that correct a robot on its way: "no, the other one", "I meant the blue one", "not the red one". The belief in the task
// that it follows drops to at most a twentieth of that in the next one.
//
// The caller sees to it:
// `robot` is null or a handle; the texts are null or C strings.
GOODBOT_MUST_USE
goodbot_status goodbot_correct(struct goodbot *robot,
                               const char *words,
                               const char *closed_words);

// Bytes that `goodbot_save` would write now.
//
// The caller sees to it:
// `robot` is null or a handle, `bytes` null or room for a number.
GOODBOT_MUST_USE goodbot_status goodbot_saved_size(const struct goodbot *robot, size_t *bytes);

// Saves everything learned, in a format that is the same on every machine. `written` receives the length.
//
// The caller sees to it:
// `robot` is null or a handle; `buffer` is null or room for `bytes` bytes; `written` is null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_save(struct goodbot *robot,
                            uint8_t *buffer,
                            size_t bytes,
                            size_t *written);

// Replaces everything learned here by a saved model. Call `goodbot_learn` until it is done. On any failure the robot is as
// before. A robot of the caller's own also takes the model of an earlier version of its table, with fewer propositions or attributes at the
// ends of their lists: nothing is lost then. `OTHER_DOMAIN` for other names or another order, `NEWER_FORMAT` for a newer library's model.
//
// The caller sees to it:
// `robot` is null or a handle; `model` is null or points to `bytes` bytes.
GOODBOT_MUST_USE
goodbot_status goodbot_restore(struct goodbot *robot,
                               const uint8_t *model,
                               size_t bytes);

// Begins to save as `goodbot_save` does, but in parts, to `buffer`: call `goodbot_save_on` until it is done. `saving` and the buffer stay
// until then.
//
// The caller sees to it:
// `saving` is null or room for one; `buffer` is null or room for `bytes` bytes.
GOODBOT_MUST_USE
goodbot_status goodbot_begin_saving(struct goodbot_saving *saving,
                                    uint8_t *buffer,
                                    size_t bytes);

// Goes on saving, at most about `budget` bytes. `WORKING` means: call again; the robot may hear, plan and act meanwhile. `CHANGED` if a
// session was learned meanwhile: begin again. Once it is done, `written` receives the length.
//
// The caller sees to it:
// `robot` is null or a handle; `saving` is null, zeros, or begun by `goodbot_begin_saving`; `written` is null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_save_on(struct goodbot *robot,
                               struct goodbot_saving *saving,
                               uint32_t budget,
                               size_t *written);

// Begins to restore as `goodbot_restore` does, but in parts: call `goodbot_restore_on` until it is done. `restoring` and the model stay until
// then.
//
// The caller sees to it:
// `restoring` is null or room for one; `model` is null or points to `bytes` bytes.
GOODBOT_MUST_USE
goodbot_status goodbot_begin_restoring(struct goodbot_restoring *restoring,
                                       const uint8_t *model,
                                       size_t bytes);

// Goes on restoring, at most about `budget` entries of the model. `WORKING` means: call again. While the model is checked, the robot is as
// before and may do anything. While it is then read, the robot knows nothing, and answers a command by `STILL_RESTORING`. Once it is done,
// call `goodbot_learn` until that is done. `CHANGED` if other work began before the whole model was read: the robot then knows nothing.
//
// The caller sees to it:
// `robot` is null or a handle; `restoring` is null, zeros, or begun by `goodbot_begin_restoring`.
GOODBOT_MUST_USE
goodbot_status goodbot_restore_on(struct goodbot *robot,
                                  struct goodbot_restoring *restoring,
                                  uint32_t budget);

// Gives the robot everyday sentences to begin with, from a starter: a model that
// `goodbot learn --starter en --learner roles --out starter.goodbot` writes. The sentences are learned from beside the robot's own sessions,
// and the more of these there are, the fewer sentences: beside n sessions, the part 1 / (1 + n / 32). Call it once the robot is made or has
// its model back, and again after `goodbot_finish`; each call replaces the sentences of the one before. Then call `goodbot_learn` until it
// is done. A session under way ends unlearned.
//
// If `model` is null, the sentences go. `goodbot_save` and `goodbot_store` save the sentences too: let them go first. `goodbot_store` then
// says `STILL_LEARNING` until `goodbot_learn` is done.
//
// `added` is null, or receives the number of sentences. `FULL` if there is no room for them: the robot then has none, as after a model that
// is refused. A session that gives way may be one of them. If more than seven give way at once, or `goodbot_finish` or its parts are broken
// off, those that are left become the robot's own.
//
// The caller sees to it:
// `robot` is null or a handle; `model` is null or points to `bytes` bytes; `added` is null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_join_starter(struct goodbot *robot,
                                    const uint8_t *model,
                                    size_t bytes,
                                    uint32_t *added);

// Saves the parameters for a robot that only obeys, which reads them by `goodbot_restore_parameters`. `written` receives the length, also
// with `BUFFER`, if `bytes` are too few. `STILL_LEARNING` until `goodbot_learn` is done.
//
// The caller sees to it:
// `robot` is null or a handle; `buffer` is null or room for `bytes` bytes; `written` is null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_save_parameters(struct goodbot *robot,
                                       uint8_t *buffer,
                                       size_t bytes,
                                       size_t *written);

// Replaces everything learned here by the parameters that `goodbot_save_parameters` or `goodbot parameters` wrote. The robot then
// understands like the one that learned them, without training. Parameters hold no lessons: a lesson given to this robot replaces them.
// On any failure the robot is as before.
//
// The caller sees to it:
// `robot` is null or a handle; `parameters` is null or points to `bytes` bytes.
GOODBOT_MUST_USE
goodbot_status goodbot_restore_parameters(struct goodbot *robot,
                                          const uint8_t *parameters,
                                          size_t bytes);

// Stores everything learned in the older of two slots, without a buffer; a plan under way is forgotten. `stored` is null, or receives the
// model's bytes. After a power cut at any moment, a whole model is left: this one or the previous one. `STILL_LEARNING` until
// `goodbot_learn` is done, `FLASH` if the flash refused or did not keep the bytes, `BUFFER` if a slot is too small, `NUMBER` if `start` or
// `slot_bytes` is no such multiple as `goodbot_flash` says.
//
// The caller sees to it:
// `robot` is null or a handle, `flash` null or points to a flash, `stored` null or room for a number.
GOODBOT_MUST_USE
goodbot_status goodbot_store(struct goodbot *robot,
                             const struct goodbot_flash *flash,
                             size_t *stored);

// Begins to store a model as `goodbot_store` does, but in parts: call `goodbot_store_on` until it is done. `model` is what `goodbot_save_on`
// wrote. It, `storing` and what `flash` leads to stay until then; the robot may do anything meanwhile. Errors as of `goodbot_store`.
//
// The caller sees to it:
// `storing` is null or room for one, `flash` null or points to a flash, `model` null or points to `bytes` bytes.
GOODBOT_MUST_USE
goodbot_status goodbot_begin_storing(struct goodbot_storing *storing,
                                     const struct goodbot_flash *flash,
                                     const uint8_t *model,
                                     size_t bytes);

// Goes on storing: reads, writes or erases at most about `budget` bytes, and at least `GOODBOT_FLASH_UNIT`; a slot is erased at once, at the
// end of a part. `WORKING` means: call again. After a power cut at any moment, a whole model is left: this one or the previous one. `FLASH` if
// the flash refuses or did not keep the bytes, `BUFFER` if a slot is too small, `BAD_MODEL` if the model's checksum is wrong; storing then
// begins anew.
//
// The caller sees to it:
// `storing` is null, zeros, or begun by `goodbot_begin_storing`.
GOODBOT_MUST_USE
goodbot_status goodbot_store_on(struct goodbot_storing *storing,
                                uint32_t budget);

// Restores the newest model of two slots, as `goodbot_restore` does: call `goodbot_learn` until it is done. `buffer` has room for it,
// and is free again afterwards. `NOTHING_STORED` if there is none; otherwise as `goodbot_store` and `goodbot_restore`.
//
// The caller sees to it:
// `robot` is null or a handle, `flash` null or points to a flash, `buffer` null or room for `bytes` bytes.
GOODBOT_MUST_USE
goodbot_status goodbot_load(struct goodbot *robot,
                            const struct goodbot_flash *flash,
                            uint8_t *buffer,
                            size_t bytes);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

/* What the library takes for granted: a program for which it does not hold is not compiled. */
#if defined(__cplusplus)
#define GOODBOT_ASSERT(name, holds) static_assert(holds, "goodbot: the library was compiled with another " #name)
#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L
#define GOODBOT_ASSERT(name, holds) _Static_assert(holds, "goodbot: the library was compiled with another " #name)
#else
#define GOODBOT_ASSERT(name, holds) typedef char goodbot_another_##name[(holds) ? 1 : -1]
#endif
#define GOODBOT_AT(type, field, at_32, at_64) \
  GOODBOT_ASSERT(type##_##field, offsetof(type, field) == (sizeof(void *) == 4 ? (at_32) : (at_64)))
#define GOODBOT_SIZE(type, size_32, size_64) GOODBOT_ASSERT(type, sizeof(type) == (sizeof(void *) == 4 ? (size_32) : (size_64)))
GOODBOT_ASSERT(bool, sizeof(bool) == 1);
GOODBOT_ASSERT(pointer, sizeof(size_t) == sizeof(void *));
GOODBOT_AT(goodbot_capacities, entries, 0, 0);
GOODBOT_SIZE(goodbot_capacities, 100, 100);
GOODBOT_AT(goodbot_lessons, sessions, 0, 0);
GOODBOT_AT(goodbot_lessons, words_per_command, 4, 4);
GOODBOT_AT(goodbot_lessons, different_words, 8, 8);
GOODBOT_AT(goodbot_lessons, word_bytes, 12, 12);
GOODBOT_SIZE(goodbot_lessons, 16, 16);
GOODBOT_AT(goodbot_sensed, name, 0, 0);
GOODBOT_AT(goodbot_sensed, x, 4, 8);
GOODBOT_AT(goodbot_sensed, y, 8, 12);
GOODBOT_SIZE(goodbot_sensed, 12, 16);
GOODBOT_AT(goodbot_carrier, object_class, 0, 0);
GOODBOT_AT(goodbot_carrier, prefix, 4, 8);
GOODBOT_SIZE(goodbot_carrier, 8, 16);
GOODBOT_AT(goodbot_attribute, name, 0, 0);
GOODBOT_AT(goodbot_attribute, carriers, 4, 8);
GOODBOT_AT(goodbot_attribute, carrier_count, 8, 16);
GOODBOT_SIZE(goodbot_attribute, 12, 24);
GOODBOT_AT(goodbot_proposition, name, 0, 0);
GOODBOT_AT(goodbot_proposition, parameters, 4, 8);
GOODBOT_AT(goodbot_proposition, parameter_count, 8, 12);
GOODBOT_SIZE(goodbot_proposition, 12, 16);
GOODBOT_AT(goodbot_object, object_class, 0, 0);
GOODBOT_AT(goodbot_object, name, 4, 8);
GOODBOT_AT(goodbot_object, values, 8, 16);
GOODBOT_SIZE(goodbot_object, 24, 48);
GOODBOT_AT(goodbot_action, name, 0, 0);
GOODBOT_AT(goodbot_action, cost, 4, 8);
GOODBOT_SIZE(goodbot_action, 8, 16);
GOODBOT_AT(goodbot_kind, classes, 0, 0);
GOODBOT_AT(goodbot_kind, class_count, 6, 6);
GOODBOT_AT(goodbot_kind, propositions, 7, 7);
GOODBOT_AT(goodbot_kind, proposition_count, 11, 11);
GOODBOT_AT(goodbot_kind, variables, 12, 12);
GOODBOT_SIZE(goodbot_kind, 24, 24);
GOODBOT_AT(goodbot_table, classes, 0, 0);
GOODBOT_AT(goodbot_table, class_count, 4, 8);
GOODBOT_AT(goodbot_table, attributes, 8, 16);
GOODBOT_AT(goodbot_table, attribute_count, 12, 24);
GOODBOT_AT(goodbot_table, propositions, 16, 32);
GOODBOT_AT(goodbot_table, proposition_count, 20, 40);
GOODBOT_AT(goodbot_table, objects, 24, 48);
GOODBOT_AT(goodbot_table, object_count, 28, 56);
GOODBOT_AT(goodbot_table, actions, 32, 64);
GOODBOT_AT(goodbot_table, action_count, 36, 72);
GOODBOT_AT(goodbot_table, tasks, 40, 80);
GOODBOT_AT(goodbot_table, task_count, 44, 88);
GOODBOT_AT(goodbot_table, state_count, 48, 92);
GOODBOT_AT(goodbot_table, start, 52, 96);
GOODBOT_AT(goodbot_table, next, 56, 104);
GOODBOT_AT(goodbot_table, step, 60, 112);
GOODBOT_AT(goodbot_table, holds, 64, 120);
GOODBOT_AT(goodbot_table, derived, 68, 128);
GOODBOT_AT(goodbot_table, context, 72, 136);
GOODBOT_AT(goodbot_table, kinds, 76, 144);
GOODBOT_SIZE(goodbot_table, 80, 152);
GOODBOT_AT(goodbot_strategy, mu_plus, 0, 0);
GOODBOT_AT(goodbot_strategy, mu_minus, 4, 4);
GOODBOT_AT(goodbot_strategy, epsilon, 8, 8);
GOODBOT_AT(goodbot_strategy, lags, 12, 12);
GOODBOT_AT(goodbot_strategy, rests, 24, 24);
GOODBOT_AT(goodbot_strategy, prior, 40, 40);
GOODBOT_SIZE(goodbot_strategy, 44, 44);
GOODBOT_AT(goodbot_hypothesis, command, 0, 0);
GOODBOT_AT(goodbot_hypothesis, weight, 4, 8);
GOODBOT_SIZE(goodbot_hypothesis, 8, 16);
GOODBOT_AT(goodbot_hazard, moved, 0, 0);
GOODBOT_AT(goodbot_hazard, rested, 4, 4);
GOODBOT_AT(goodbot_hazard, resting, 8, 8);
GOODBOT_AT(goodbot_hazard, praised, 12, 12);
GOODBOT_AT(goodbot_hazard, scolded, 16, 16);
GOODBOT_SIZE(goodbot_hazard, 20, 20);
GOODBOT_AT(goodbot_options, telling, 0, 0);
GOODBOT_AT(goodbot_options, drift, 4, 4);
GOODBOT_AT(goodbot_options, ends_at_goal, 8, 8);
GOODBOT_AT(goodbot_options, ends_elsewhere, 28, 28);
GOODBOT_AT(goodbot_options, weights, 48, 48);
GOODBOT_AT(goodbot_options, least_weight, 52, 52);
GOODBOT_AT(goodbot_options, done, 56, 56);
GOODBOT_SIZE(goodbot_options, 60, 60);
GOODBOT_AT(goodbot_listened, tasks, 0, 0);
GOODBOT_AT(goodbot_listened, verdict, 8, 8);
GOODBOT_AT(goodbot_listened, taken_for, 12, 12);
GOODBOT_AT(goodbot_listened, task, 16, 16);
GOODBOT_AT(goodbot_listened, probability, 20, 20);
GOODBOT_AT(goodbot_listened, command, 24, 24);
GOODBOT_AT(goodbot_listened, sure, 28, 28);
GOODBOT_AT(goodbot_listened, rest, 32, 32);
GOODBOT_AT(goodbot_listened, unread, 36, 36);
GOODBOT_SIZE(goodbot_listened, 40, 40);
GOODBOT_AT(goodbot_saving, opaque, 0, 0);
GOODBOT_SIZE(goodbot_saving, 64, 128);
GOODBOT_AT(goodbot_restoring, opaque, 0, 0);
GOODBOT_SIZE(goodbot_restoring, 320, 640);
GOODBOT_AT(goodbot_flash, context, 0, 0);
GOODBOT_AT(goodbot_flash, read, 4, 8);
GOODBOT_AT(goodbot_flash, write, 8, 16);
GOODBOT_AT(goodbot_flash, erase, 12, 24);
GOODBOT_AT(goodbot_flash, start, 16, 32);
GOODBOT_AT(goodbot_flash, slot_bytes, 20, 36);
GOODBOT_SIZE(goodbot_flash, 24, 40);
GOODBOT_AT(goodbot_storing, opaque, 0, 0);
GOODBOT_SIZE(goodbot_storing, 128, 256);
#undef GOODBOT_SIZE
#undef GOODBOT_AT
#undef GOODBOT_ASSERT

#endif  /* GOODBOT_H */

/** Aligns a robot's memory, in C and in C++: `GOODBOT_ALIGNED static unsigned char memory[GOODBOT_SMALL_BYTES];` */
#ifdef __cplusplus
#define GOODBOT_ALIGNED alignas(8)
#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L
#define GOODBOT_ALIGNED _Alignas(8)
#else
#define GOODBOT_ALIGNED __attribute__((aligned(8)))
#endif
/** Bytes of a robot in a home, known when the program is compiled, also in `#if`. */
#if UINTPTR_MAX > 0xffffffff
#define GOODBOT_SMALL_BYTES GOODBOT_SMALL_BYTES_64
#define GOODBOT_TINY_BYTES GOODBOT_TINY_BYTES_64
#define GOODBOT_OWN_BYTES GOODBOT_OWN_BYTES_64
#else
#define GOODBOT_SMALL_BYTES GOODBOT_SMALL_BYTES_32
#define GOODBOT_TINY_BYTES GOODBOT_TINY_BYTES_32
#define GOODBOT_OWN_BYTES GOODBOT_OWN_BYTES_32
#endif
/** Bytes of a robot of the caller's own. */
#define GOODBOT_SMALL_TABLE_BYTES (GOODBOT_SMALL_BYTES + GOODBOT_TABLE_BYTES)
#define GOODBOT_TINY_TABLE_BYTES (GOODBOT_TINY_BYTES + GOODBOT_TABLE_BYTES)
/** Names of the version before, for one release more. */
#define goodbot_done goodbot_acted
#define GOODBOT_EVIDENCE_NOTHING GOODBOT_EVIDENCE_UNINFORMATIVE
