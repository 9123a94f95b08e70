/** The version of goodbot, which the builder puts in. */
declare const GOODBOT_VERSION: string;
