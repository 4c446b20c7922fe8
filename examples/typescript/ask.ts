/** The answer to a request; where the service refuses it, an error with the reason. */
export async function ask(address: string, request: RequestInit = {}): Promise<Response> {
  const answer = await fetch(address, request);
  if (!answer.ok) throw new Error(((await answer.json()) as { detail: string }).detail);
  return answer;
}

/** The JSON document at an address. */
export async function read<T>(address: string): Promise<T> {
  return (await (await ask(address)).json()) as T;
}
