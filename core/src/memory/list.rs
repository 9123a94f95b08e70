//! The list of all tables: each table's name, element type, empty element and length. All memory is made from it.

/// Hands each table of a home to another macro.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_home_table {
    ($($then:ident)::+!($($head:tt)*)) => {
        $($then)::+! {
            $($head)*
            objects: $crate::oomdp::Object = $crate::oomdp::Object::UNUSED; objects,
            name_bytes: u8 = 0; name_bytes,
            name_ends: u16 = 0; names,
            areas: $crate::home::StoredArea = $crate::home::StoredArea::UNUSED; objects,
            places: $crate::home::Place = $crate::home::Place::UNUSED; cells,
        }
    };
}

/// Hands each table of an agent to another macro.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_agent_table {
    ($($then:ident)::+!($($head:tt)*)) => {
        $($then)::+! {
            $($head)*
            word_bytes: u8 = 0; word_bytes,
            word_ends: u16 = 0; words,
            token_bytes: u8 = 0; token_bytes,
            token_ends: u16 = 0; tokens,
            commands: $crate::language::Span = $crate::language::Span::UNUSED; commands,
            command_tokens: $crate::symbols::Symbol = $crate::symbols::Symbol::new(0); command_tokens,
            sessions: $crate::language::Span = $crate::language::Span::UNUSED; sessions,
            sentence_words: $crate::symbols::Symbol = $crate::symbols::Symbol::new(0); sentence_words,
            pairs: $crate::language::Pair = $crate::language::Pair::UNUSED; pairs,
            translations: f32 = 0.0; translations,
            alignments: f32 = 0.0; alignments,
            length_pairs: $crate::language::LengthPair = $crate::language::LengthPair::UNUSED; length_pairs,
            grounded: $crate::task::GroundedTask = $crate::task::GroundedTask::UNUSED; tasks,
            candidates: $crate::session::Candidate = $crate::session::Candidate::UNUSED; candidates,
            candidate_tokens: $crate::symbols::Symbol = $crate::symbols::Symbol::new(0); candidate_tokens,
            joint: $crate::probability::Scaled = $crate::probability::Scaled::ZERO; beliefs,
            settled: $crate::probability::Scaled = $crate::probability::Scaled::ZERO; beliefs,
            priors: $crate::probability::Scaled = $crate::probability::Scaled::ZERO; tasks,
            strategies: ($crate::feedback::Strategy, f32) = ($crate::feedback::Strategy::UNUSED, 0.0); strategies,
            expected: f32 = 0.0; strategies,
            goal_parts: $crate::planning::GoalPart = $crate::planning::GoalPart::UNUSED; ground_propositions,
            goal_entries: $crate::task::TaskSet = $crate::task::TaskSet::EMPTY; goal_entries,
            workspace: u64 = 0; workspace_words(),
            // Takes no bytes: its length says how much of the workspace is for the search.
            search_words: () = (); search_words(),
            hashed: u64 = 0; hashed_states,
            optimal: $crate::oomdp::ActionSet = $crate::oomdp::ActionSet::EMPTY; tasks,
            distances: u32 = 0; tasks,
        }
    };
}

/// Hands the tables of a home and those of an agent to another macro together.
#[doc(hidden)]
#[macro_export]
macro_rules! all_memory {
    ($($then:ident)::+!($($head:tt)*) $($tables:tt)*) => { $crate::for_each_agent_table! { $($then)::+!($($head)* $($tables)*) } };
}

/// The tables of a home from a value that has a field for each: to be written (`mut`), or to be read.
#[doc(hidden)]
#[macro_export]
macro_rules! home_tables {
    (mut $it:expr) => { $crate::home_tables!($it, HomeTables ObjectTables as_mut) };
    (ref $it:expr) => { $crate::home_tables!($it, HomeTablesRef ObjectTablesRef as_ref) };
    ($it:expr, $Home:ident $Objects:ident $slice:ident) => {{
        let it = $it;
        $crate::home::$Home {
            objects: $crate::oomdp::$Objects {
                objects: it.objects.$slice(),
                name_bytes: it.name_bytes.$slice(),
                name_ends: it.name_ends.$slice(),
            },
            areas: it.areas.$slice(),
            places: it.places.$slice(),
        }
    }};
}

/// The tables of an agent from a value that has a field for each: to be written (`mut`), or to be read.
#[doc(hidden)]
#[macro_export]
macro_rules! agent_tables {
    (mut $it:expr) => {
        $crate::agent_tables!(
            $it, AgentTables LanguageTables BitextTables ParameterTables SessionTables CandidateTables BeliefTables GoalMemory PlanMemory as_mut
        )
    };
    (ref $it:expr) => {
        $crate::agent_tables!(
            $it, AgentTablesRef LanguageTablesRef BitextTablesRef ParameterTablesRef SessionTablesRef CandidateTablesRef BeliefTablesRef
            GoalMemoryRef PlanMemoryRef as_ref
        )
    };
    ($it:expr, $Agent:ident $Language:ident $Bitext:ident $Parameters:ident $Session:ident $Candidates:ident $Belief:ident $Goals:ident
        $Plan:ident $slice:ident) => {{
        let it = $it;
        $crate::memory::$Agent {
            language: $crate::language::$Language {
                word_bytes: it.word_bytes.$slice(),
                word_ends: it.word_ends.$slice(),
                token_bytes: it.token_bytes.$slice(),
                token_ends: it.token_ends.$slice(),
                bitext: $crate::language::$Bitext {
                    commands: it.commands.$slice(),
                    command_tokens: it.command_tokens.$slice(),
                    sessions: it.sessions.$slice(),
                    sentence_words: it.sentence_words.$slice(),
                    pairs: it.pairs.$slice(),
                },
                parameters: $crate::language::$Parameters {
                    translations: it.translations.$slice(),
                    alignments: it.alignments.$slice(),
                    length_pairs: it.length_pairs.$slice(),
                },
                layer: ::core::default::Default::default(),
            },
            session: $crate::session::$Session {
                tasks: it.grounded.$slice(),
                candidates: $crate::session::$Candidates { entries: it.candidates.$slice(), tokens: it.candidate_tokens.$slice() },
                belief: $crate::feedback::$Belief {
                    joint: it.joint.$slice(),
                    settled: it.settled.$slice(),
                    priors: it.priors.$slice(),
                    strategies: it.strategies.$slice(),
                    expected: it.expected.$slice(),
                },
                goals: $crate::planning::$Goals { parts: it.goal_parts.$slice(), entries: it.goal_entries.$slice() },
                plan: $crate::planning::$Plan {
                    search_words: it.search_words.$slice(),
                    hashed: it.hashed.$slice(),
                    optimal: it.optimal.$slice(),
                    distances: it.distances.$slice(),
                },
            },
            workspace: it.workspace.$slice(),
        }
    }};
}
