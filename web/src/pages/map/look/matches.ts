/** Which codes and names fit what is typed. */

export interface Named {
  /** Code, name or label: what people call it. */
  readonly names: readonly string[];
}

/** Those that fit best come first: the same, then those that begin so, then those that contain it. */
export function matches<T extends Named>(all: readonly T[], typed: string, most: number): T[] {
  const wanted = typed.trim().toLowerCase();
  if (wanted === "") return [];
  const rank = ({ names }: T): number => {
    const ranks = names.map((name) => {
      const text = name.toLowerCase();
      return text === wanted ? 0 : text.startsWith(wanted) ? 1 : text.includes(wanted) ? 2 : 3;
    });
    return Math.min(3, ...ranks);
  };
  const ranked = all.map((one) => [rank(one), one] as const).filter(([value]) => value < 3);
  const byRankThenName = (left: readonly [number, T], right: readonly [number, T]): number =>
    left[0] - right[0] || (left[1].names[0] ?? "").localeCompare(right[1].names[0] ?? "", undefined, { numeric: true });
  return ranked
    .sort(byRankThenName)
    .slice(0, most)
    .map(([, one]) => one);
}
