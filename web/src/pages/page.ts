/** What the address can name. */
export interface Page {
  readonly element: HTMLElement;
  /** Ends what the page goes on doing when another one is shown. */
  leave(): void;
}
