//! The one list of all tables: purpose, name, element type, empty element and length of each. All memory is made from it.
//!
//! Tables that are used together form a group, a struct of slices. A group lists its own tables in braces and then its parts, which are
//! groups listed before it. The last group is the whole.

/// Hands the tables of a home to another macro.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_home_table {
    ($($then:ident)::+!($($head:tt)*)) => {
        $($then)::+! {
            $($head)*
            HomeMemory home HomeTables HomeTablesRef;
            /// The objects and their names.
            objects: ObjectTables ObjectTablesRef {
                /// One entry per object.
                objects: $crate::oomdp::Object = $crate::oomdp::Object::UNUSED; objects,
                /// Names and attribute values.
                name_bytes: u8 = 0; name_bytes,
                /// One entry per name or value.
                name_ends: u16 = 0; names,
            } ()
            /// The tables of one home.
            home: HomeTables HomeTablesRef {
                /// One entry per object: its box.
                areas: $crate::home::StoredArea = $crate::home::StoredArea::UNUSED; objects,
                /// One entry per free cell.
                places: $crate::home::Place = $crate::home::Place::UNUSED; cells,
            } (objects: ObjectTables ObjectTablesRef,)
        }
    };
}

/// Hands the tables of an agent to another macro.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_agent_table {
    ($($then:ident)::+!($($head:tt)*)) => {
        $($then)::+! {
            $($head)*
            AgentMemory agent AgentTables AgentTablesRef;
            /// The tables of the training data.
            bitext: BitextTables BitextTablesRef {
                /// One entry per distinct machine command.
                commands: $crate::language::Span = $crate::language::Span::UNUSED; commands,
                /// Their tokens.
                command_tokens: $crate::symbols::Symbol = $crate::symbols::Symbol::new(0); command_tokens,
                /// One entry per session.
                sessions: $crate::language::Span = $crate::language::Span::UNUSED; sessions,
                /// The words of their English commands.
                sentence_words: $crate::symbols::Symbol = $crate::symbols::Symbol::new(0); sentence_words,
                /// One entry per pair.
                pairs: $crate::language::Pair = $crate::language::Pair::UNUSED; pairs,
            } ()
            /// The tables of the parameters.
            parameters: ParameterTables ParameterTablesRef {
                /// One row of words for NULL (Model 2) or the background (role model), and one per machine token.
                translations: f32 = 0.0; translations,
                /// Model 2: a(j | i, l, n). The role model: all its other parameters.
                alignments: f32 = 0.0; alignments,
                /// Model 2: one entry per pair of lengths.
                length_pairs: $crate::language::LengthPair = $crate::language::LengthPair::UNUSED; length_pairs,
            } ()
            /// The tables of a language model.
            language: LanguageTables LanguageTablesRef {
                /// The English words, concatenated.
                word_bytes: u8 = 0; word_bytes,
                /// One entry per English word.
                word_ends: u16 = 0; words,
                /// The machine tokens, concatenated.
                token_bytes: u8 = 0; token_bytes,
                /// One entry per machine token.
                token_ends: u16 = 0; tokens,
                /// One entry if a host has memory for the layer: see `AgentHeap::with_layer`.
                layer: $crate::language::layer::LayerMemory = $crate::language::layer::LayerMemory::NONE; none(),
            } (bitext: BitextTables BitextTablesRef, parameters: ParameterTables ParameterTablesRef,)
            /// The tables of the candidates.
            candidates: CandidateTables CandidateTablesRef {
                /// One entry per distinct machine command.
                candidates: $crate::session::Candidate = $crate::session::Candidate::UNUSED; candidates,
                /// Their tokens.
                candidate_tokens: $crate::symbols::Symbol = $crate::symbols::Symbol::new(0); candidate_tokens,
                /// The role model: one entry per task, the position of its description among the candidates.
                described: u8 = 0; tasks,
            } ()
            /// The tables of the belief.
            belief: BeliefTables BeliefTablesRef {
                /// One entry per task and strategy.
                joint: $crate::probability::Scaled = $crate::probability::Scaled::ZERO; beliefs,
                /// The same, before the last piece of evidence.
                settled: $crate::probability::Scaled = $crate::probability::Scaled::ZERO; beliefs,
                /// One entry per task: its prior.
                priors: $crate::probability::Scaled = $crate::probability::Scaled::ZERO; tasks,
                /// One entry per strategy, with its probability.
                strategies: ($crate::feedback::Strategy, f32) = ($crate::feedback::Strategy::UNUSED, 0.0); strategies,
                /// One entry per strategy: its probability before this trainer was met.
                expected: f32 = 0.0; strategies,
            } ()
            /// The tables of the goals.
            goals: GoalMemory GoalMemoryRef {
                /// One entry per distinct ground proposition.
                goal_parts: $crate::planning::GoalPart = $crate::planning::GoalPart::UNUSED; ground_propositions,
                /// One entry per cell and piece. If there are too few, propositions are tested one by one.
                goal_entries: $crate::task::TaskSet = $crate::task::TaskSet::EMPTY; goal_entries,
            } ()
            /// The tables of the searches and their results.
            plan: PlanMemory PlanMemoryRef {
                /// One entry per workspace word of first actions and frontier: see
                /// [`Capacities::search_words`](crate::Capacities::search_words). It takes no bytes.
                search_words: () = (); search_words(),
                /// State numbers of a hashed search; may be empty.
                hashed: u64 = 0; hashed_states,
                /// The optimal set of each task.
                optimal: $crate::oomdp::ActionSet = $crate::oomdp::ActionSet::EMPTY; tasks,
                /// The distance of each task.
                distances: u32 = 0; tasks,
            } ()
            /// The tables of one session.
            session: SessionTables SessionTablesRef {
                /// One entry per grounded task.
                tasks: $crate::task::GroundedTask = $crate::task::GroundedTask::UNUSED; tasks,
            } (
                candidates: CandidateTables CandidateTablesRef,
                belief: BeliefTables BeliefTablesRef,
                goals: GoalMemory GoalMemoryRef,
                plan: PlanMemory PlanMemoryRef,
            )
            /// The tables of one agent.
            agent: AgentTables AgentTablesRef {
                /// Shared: planning and training use it in turn.
                workspace: u64 = 0; workspace_words(),
            } (language: LanguageTables LanguageTablesRef, session: SessionTables SessionTablesRef,)
        }
    };
}
