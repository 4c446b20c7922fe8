/** A text in both languages. */
export type Text = readonly [english: string, german: string];

/** Texts by their names. */
export type Texts = Readonly<Record<string, Text>>;
