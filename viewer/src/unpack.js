(async () => {
  const packed = Uint8Array.from(atob(document.getElementById("client").textContent), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  document.body.append(Object.assign(document.createElement("script"), { textContent: await new Response(stream).text() }));
})();
